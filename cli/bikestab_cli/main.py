"""bikestab: where a bicycle or motorcycle runs straight by itself."""

from __future__ import annotations

import importlib
import os
import sys

import click

from bikestab import __version__
from bikestab.errors import BikestabError, InputError, nearest

COMMANDS = ("scan", "vrange", "slice", "check", "info", "bicycles", "init", "schema")


class _Lazy(click.Group):
    """Imports the module of a command only when that command is wanted."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        if name not in COMMANDS:
            return None
        command: click.Command = importlib.import_module(f"bikestab_cli.{name}").command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args and args[0] not in COMMANDS and not args[0].startswith("-"):
            raise click.UsageError(f"there is no command {args[0]!r}; {nearest(args[0], COMMANDS)}", ctx)
        return super().resolve_command(ctx, args)


@click.group(cls=_Lazy, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, message="%(prog)s %(version)s")
def cli() -> None:
    """Map where a bicycle or motorcycle runs straight by itself.

    The map is the set of steering-axis tilt λ [rad], dimensionless trail σ and speed V [m/s] in
    which rectilinear motion is stable, after Dikarev, Dikareva and Fufaev (1981).

    \b
    Examples:
      bikestab vrange --lam 0.2 --sigma 0.08
      bikestab vrange --bicycle meijaard2007
      bikestab scan configs/quick.yaml
    """


def main() -> None:
    """Run the command line; errors are one to three lines on stderr, never a traceback."""
    try:
        code = cli.main(prog_name="bikestab", standalone_mode=False)
        sys.stdout.flush()
    except click.UsageError as error:
        help_of = error.ctx.command_path if error.ctx else "bikestab"
        _fail(2, error.format_message(), f"see '{help_of} --help'")
    except click.ClickException as error:
        _fail(2, error.format_message())
    except (click.Abort, KeyboardInterrupt):
        _fail(130, "interrupted")
    except InputError as error:
        _fail(2, str(error))
    except BikestabError as error:
        _fail(3, str(error))
    except MemoryError:
        _fail(3, "not enough memory", "take fewer values, or fewer fields")
    except BrokenPipeError:  # the reader of a pipe, such as head, has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    sys.exit(code if isinstance(code, int) else 0)


def _fail(code: int, message: str, hint: str = "") -> None:
    click.echo("error: " + "\n  ".join([*message.split("\n"), *([hint] if hint else [])]), err=True)
    sys.exit(code)
