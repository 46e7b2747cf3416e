"""bikestab schema: the JSON Schema of a config, for editors."""

from __future__ import annotations

import click
from bikestab_cli.output import print_json


@click.command("schema")
def command() -> None:
    """Print the JSON Schema of a config, for editors.

    It gives completion and checks while typing.

    In VS Code and others with the YAML language server, put this in the first line of a config:
    # yaml-language-server: $schema=bikestab.schema.json

    \b
    Example:
      bikestab schema > bikestab.schema.json
    """
    from bikestab.config.file import config_schema

    print_json(config_schema())
