"""What --json prints is what its JSON Schema says, from which docs/json.md is made; tables are narrow."""

import importlib.util
import json
from pathlib import Path

import jsonschema
import pytest
from bikestab_cli.main import COMMANDS, cli
from bikestab_cli.schemas import SCHEMAS

from bikestab.design import best as best_module
from bikestab.design import search

ROOT = Path(__file__).parents[2]
TINY = """\
bicycle: meijaard2007
grid: {lam: {values: [0.2, 0.3]}, sigma: {values: [0.05, 0.08]}, V: {values: [3, 5]}}
sweep: {delta: [0, 1]}
ensemble: {mB: {normal: [85, 8]}, samples: 5}
expect: [{V1: 4.29, within: 1%}, {lam: 0.1, sigma: 0.02, stable: never}, {V1: 4, V2: unbounded}]
"""
BENCHMARK = ("--bicycle", "meijaard2007")
BOX = ("--lam", "17deg:19deg", "--sigma", "0.07:0.08", "--cells", "2")
CASES = [
    ("vrange", "--lam", "0.1", "--sigma", "0.08"),
    ("vrange", *BENCHMARK, "--bicycle", "kooijman2011", "--set", "g=9.81,3", "-o", "a.png"),
    ("vrange", *BENCHMARK, "--sd", "c=30mm"),
    ("vrange", *BENCHMARK, "--bicycle", "dikarev1981"),
    ("eigen", *BENCHMARK, "--V", "0:5:3", "--csv", "a.csv"),
    ("eigen", *BENCHMARK, "--bicycle", "dikarev1981", "--V", "0:5:3", "-o", "a.png", "--csv", "a.csv"),
    ("eigen", *BENCHMARK, "--bicycle", "dikarev1981", "--over", "delta=0:5:4", "--at", "4"),
    ("eigen", "--lam", "0.1", "--sigma", "0.08", "--set", "m1=80,90", "--V", "2"),
    ("eigen", *BENCHMARK, "--shapes", "--at", "5"),
    ("eigen", *BENCHMARK, "--push", "roll_rate=0.5,steer=2deg", "--csv", "a.csv", "-o", "a.svg"),
    ("eigen", *BENCHMARK, "--over", "delta=0:5:4", "--at", "4", "--set", "mB=80,90"),
    ("vrange", *BENCHMARK, "--over", "delta=0:5:4"),
    ("design", *BENCHMARK, "--over", "mB=60:110", "--over", "offset=0:8cm", "--V", "5"),
    ("design", *BENCHMARK, "--V", "5", "--csv", "a.csv"),
    ("design", "--stable", "1:20"),
    ("design", *BENCHMARK, "--certified", "--sd", "trail=5mm", "--stable", "4.6:5.4"),
    ("design", *BENCHMARK, "--bicycle", "sharp1971", "--offset", "0:8cm"),
    ("design", "--bicycle", "dikarev1981", *BENCHMARK, "--free", "trail=3cm:8cm"),
    ("sensitivity", *BENCHMARK, "--sd", "c=10mm"),
    ("sensitivity", *BENCHMARK, "--bicycle", "sharp1971"),
    ("sensitivity", *BENCHMARK, "--bicycle", "dikarev1981", "-o", "a.png"),
    ("sensitivity", "--lam", "0.1", "--sigma", "0.08"),
    ("certify", *BENCHMARK, *BOX, "--V", "4.9:5"),
    ("certify", *BENCHMARK, *BOX, "--V", "3:5", "-o", "proof.json"),
    ("check", "tiny.yaml", "none.yaml", "--junit", "a.xml"),
    ("compare", "meijaard2007", "sharp1971", "--within", "1%"),
    ("compare", "dikarev1981", "tiny.yaml", "--at", "delta=0"),
    ("compare", "meijaard2007", "sharp1971", "kooijman2011", "--within", "1%"),
    ("bicycles",),
    ("scan", "tiny.yaml", "--quiet", "--force"),
    ("info", "volume"),
]


def schemas_of(schema):
    """The parts of a schema that are schemas."""
    yield schema
    for inner in schema.get("properties", {}).values():
        yield from schemas_of(inner)
    for inner in (*schema.get("anyOf", []), *([schema["items"]] if "items" in schema else [])):
        yield from schemas_of(inner)


@pytest.fixture
def small(bikestab, monkeypatch):
    monkeypatch.setattr(best_module, "GRID", 21)
    monkeypatch.setattr(search, "ROUNDS", 6)
    monkeypatch.setattr(search, "ROUNDS_TOGETHER", 4)
    Path("tiny.yaml").write_text(TINY, "utf-8")
    return bikestab


@pytest.mark.parametrize("args", CASES, ids=" ".join)
def test_what_is_printed_is_as_the_schema_says(small, args):
    if args[0] == "info":
        args = ("info", "out/tiny")
        assert small("scan", "tiny.yaml", "--quiet", "--set", "slices=[]")[0] == 0
    code, out, err = small(*args, "--json")
    assert code in (0, 1, 2), err
    found = json.loads(out, parse_constant=pytest.fail)
    jsonschema.validate(found, SCHEMAS[args[0]])


def test_every_command_with_json_has_a_schema_and_a_case():
    commands = {name: cli.get_command(None, name) for name in COMMANDS}
    with_json = {
        name for name, command in commands.items() if any("--json" in p.opts for p in command.params)
    }
    assert with_json == set(SCHEMAS) == {name for name, *_ in CASES}


@pytest.mark.parametrize("name", SCHEMAS)
def test_the_schemas_are_schemas_and_closed(bikestab, name):
    schema = SCHEMAS[name]
    jsonschema.Draft202012Validator.check_schema(schema)
    assert json.loads(bikestab("schema", name)[1]) == json.loads(json.dumps(schema))
    for inner in schemas_of(schema):
        assert "properties" not in inner or "additionalProperties" in inner


@pytest.mark.parametrize("view", [("--V", "0:5:3"), ("--shapes", "--at", "5"), ("--push", "roll_rate=0.5")])
def test_the_schema_of_eigen_wants_all_that_belongs_to_what_is_asked(bikestab, view):
    found = json.loads(bikestab("eigen", *BENCHMARK, *view, "--json")[1])
    (result,) = found["results"]
    for key in result:
        without = {name: value for name, value in result.items() if name != key}
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**found, "results": [without]}, SCHEMAS["eigen"])


def test_whose_a_result_is_stands_beside_it_where_there_are_several(bikestab):
    """As docs/json.md says of all commands about machines."""
    for args in (("vrange",), ("eigen", "--V", "5:5:1"), ("sensitivity",)):
        own = json.loads(bikestab(*args, *BENCHMARK, "--json")[1])
        assert (own["bicycle"], own["delta"], "bicycle" in own["results"][0]) == ("meijaard2007", 0, False)
        found = json.loads(bikestab(*args, *BENCHMARK, "--bicycle", "sharp1971", "--json")[1])
        assert [each["bicycle"] for each in found["results"]] == found["bicycle"]
        assert found["bicycle"] == ["meijaard2007", "sharp1971"]
        assert len(found["delta"]) == 2
        found = json.loads(bikestab(*args, *BENCHMARK, "--set", "mB=80,90", "--json")[1])
        assert [each["set"] for each in found["results"]] == [{"mB": 80}, {"mB": 90}]
        assert (found["bicycle"], found["delta"]) == ("meijaard2007", 0)


def test_a_schema_that_is_not_there(bikestab):
    code, out, err = bikestab("schema", "vrnge")
    assert (code, out) == (2, "")
    assert "'vrnge' has no --json; did you mean 'vrange'?" in err


def test_the_page_is_made_from_the_schemas():
    spec = importlib.util.spec_from_file_location("json_page", ROOT / "docs" / "json_page.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.PAGE.read_text("utf-8") == module.page(), "run: python docs/json_page.py"


# --- tables


TABLES = [
    *(args for args in CASES if args[0] not in ("scan", "info", "check", "design")),
    ("check", "tiny.yaml"),
    ("vrange", *BENCHMARK, "--lam", "0.05:0.3:3", "--sigma", "0.1:0.15:2"),
    ("vrange", "--lam", "0.04834835", "--sigma", "0.15", "--sd", "c=10mm"),
    ("eigen", "--lam", "0.05", "--sigma", "0.15", "--V", "0:1000:3"),
    ("eigen", *BENCHMARK, "--set", "mB=60,123.4567", "--set", "xB=0.31", "--V", "0:500:3"),
    ("eigen", "--bicycle", "a-bicycle-of-my-own-with-a-long-name.yaml", "--bicycle", "sharp1971"),
    ("design", *BENCHMARK, "--V", "5", "--V-max", "1000"),
    ("design", *BENCHMARK, "--bicycle", "sharp1971", "--stable", "4:30", "--V", "6"),
    ("design", "--stable", "1:20"),
    ("sensitivity", "--lam", "0.04834835", "--sigma", "0.15"),
    ("compare", "meijaard2007", "a-bicycle-of-my-own-with-a-long-name.yaml", "--delta", "123.456"),
    ("info", "out/tiny"),
]


@pytest.mark.parametrize("args", TABLES, ids=" ".join)
def test_tables_fit_80_columns(small, args):
    from bikestab.presets import preset_text

    Path("a-bicycle-of-my-own-with-a-long-name.yaml").write_text(preset_text("meijaard2007"), "utf-8")
    if args[0] == "info":
        assert small("scan", "tiny.yaml", "--quiet")[0] == 0
    code, out, err = small(*args)
    assert code in (0, 1) or (code == 2 and out), err  # a table of several, one of which cannot be used
    assert [line for line in out.splitlines() if len(line) > 80 and "/" not in line] == []
