"""Two small volumes that tests read: one with all fields, one with axes of one's own values."""

from bikestab import yamltext
from bikestab.config.file import parse_config

EQUAL = """\
title: a small scan
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 7}
  sigma: {start: 0.05, stop: 0.15, num: 5}
  V: {start: 0, stop: 10, num: 11}
fields: [stable, violated, growth_rate, conditions]
output: OUT
"""
# (0.04834835, 0.15) has two stable intervals, the first of them 2 mm/s wide
OWN = """\
bicycle: dikarev1981
delta: 0
grid:
  lam: {values: [0, 0.015, 0.04834835, 0.2]}
  sigma: {values: [0.08, 0.1475, 0.15]}
  V: {values: [0, 1, 3, 5, 30]}
output: OUT
"""


def config_of(text, folder):
    return parse_config(yamltext.parse(text.replace("OUT", str(folder)), "scan.yaml"))
