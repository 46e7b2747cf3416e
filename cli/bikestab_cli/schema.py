"""bikestab schema: the JSON Schema of a config, for editors, and of what commands print."""

from __future__ import annotations

import click
from bikestab_cli.output import print_json

from bikestab.errors import nearest


def _complete(_: click.Context, __: click.Parameter, incomplete: str) -> list[str]:
    from bikestab_cli.schemas import SCHEMAS

    return [name for name in SCHEMAS if name.startswith(incomplete)]


@click.command("schema")
@click.argument("name", required=False, metavar="[COMMAND]", shell_complete=_complete)
def command(name: str | None) -> None:
    """Print the JSON Schema of a config, for editors, or of what COMMAND prints with --json.

    It gives completion and checks while typing.

    In VS Code and others with the YAML language server, put this in the first line of a config:
    # yaml-language-server: $schema=bikestab.schema.json

    \b
    Examples:
      bikestab schema > bikestab.schema.json
      bikestab schema vrange
    """
    if name is not None:
        from bikestab_cli.schemas import SCHEMAS

        if name not in SCHEMAS:
            raise click.BadParameter(
                f"{name!r} has no --json; {nearest(name, SCHEMAS)}", param_hint="COMMAND"
            )
        print_json(SCHEMAS[name])
        return
    from bikestab.config.file import config_schema

    print_json(config_schema())
