"""bikestab: where a bicycle or motorcycle runs straight by itself."""

from __future__ import annotations

import atexit
import gc
import importlib
import os
import sys
import warnings
from contextlib import suppress
from pathlib import Path

import click
from bikestab_cli.messages import cut
from bikestab_cli.once import check_once
from bikestab_cli.streams import tell_error, visible_streams

from bikestab import __version__
from bikestab.errors import BikestabError, InputError, ScanError, nearest
from bikestab.files import MAKE_ROOM, NO_SPACE, NOT_THERE

COMMANDS = (
    "scan", "vrange", "sensitivity", "eigen", "design", "slice", "export", "report", "reproduce", "certify",
    "check", "compare", "info", "bicycles", "convert", "init", "schema", "completion",
)  # fmt: skip
COMPLETE = "_BIKESTAB_COMPLETE"  # set by a shell that wants words
LEAST_MEMORY = 512 << 20
_GARBAGE = 20_000  # objects after which it is looked for: imports make many of them, and none is garbage
_NO_MEMORY = "failed to map segment"  # the loader's words for it
DEVELOPER = "please report it, with what 'python -X dev -m bikestab ...' shows"

NOWHERE = "the current folder was removed: go to one that is there"


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
        name, command, rest = super().resolve_command(ctx, args)
        if command and not ctx.resilient_parsing:  # as for a shell that completes words
            check_once(command, ctx, rest)
        return name, command, rest


@click.group(cls=_Lazy, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, "-V", "--version", message="%(prog)s %(version)s")
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


def main(program: str = "bikestab") -> None:
    """Run the command line; errors are one to three lines on stderr, never a traceback.

    ``program`` is what was typed to run it.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices are 4 × 4, and each thread takes 30 MB
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")  # it looks for them in all that is installed
    if not (
        sys.warnoptions or sys.flags.dev_mode or any(action == "error" for action, *_ in warnings.filters)
    ):
        warnings.simplefilter("ignore")  # numpy's and matplotlib's tell a user nothing
    gc.set_threshold(_GARBAGE)
    atexit.register(gc.freeze)  # the exit is 10 ms sooner if it looks for no garbage
    if os.environ.get(COMPLETE):
        from click.shell_completion import shell_complete

        sys.exit(shell_complete(cli, {}, program, COMPLETE, os.environ[COMPLETE]))
    code = 0
    with visible_streams():
        try:
            code = _run(program, sys.argv[1:])
            sys.stdout.flush()
        except BrokenPipeError:  # the reader of a pipe, such as head, has had enough
            _drop_output()
        except OSError as error:
            _drop_output()
            hint = MAKE_ROOM if error.errno in NO_SPACE else "" if _somewhere() else NOWHERE
            code = _tell(3, f"could not finish: {error.strerror or error}", hint)
    sys.exit(code)


def _somewhere() -> bool:
    with suppress(FileNotFoundError):
        return bool(Path.cwd())
    return False


def _run(program: str, args: list[str]) -> int:
    try:
        _check_memory()
        with cli.make_context(program, args) as context:
            cli.invoke(context)
    except click.exceptions.Exit as end:
        return end.exit_code
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message(), err=True)
        return 2
    except click.UsageError as error:
        words = error.ctx.command_path if error.ctx else program
        if words == program and args and args[0] in COMMANDS:
            words = f"{program} {args[0]}"
        return _tell(2, error.format_message(), f"see '{words} --help'")
    except click.ClickException as error:
        return _tell(2, error.format_message())
    except (click.Abort, KeyboardInterrupt) as error:
        return _tell(130, "interrupted", str(error))
    except InputError as error:
        return _tell(2, str(error))
    except BikestabError as error:
        return _tell(3, str(error))
    except OSError as error:
        if isinstance(error, BrokenPipeError) or error.filename is None:  # which main tells of
            raise
        return _tell(2 if error.errno in NOT_THERE else 3, f"{error.filename}: {error.strerror or error}")
    except Exception as error:
        if isinstance(error, MemoryError) or (isinstance(error, ImportError) and _NO_MEMORY in str(error)):
            return _tell(3, "not enough memory", "take fewer values, or fewer fields")
        if sys.flags.dev_mode:
            raise
        problem = cut(" ".join(f"{type(error).__name__}: {error}".split()), 150)
        return _tell(3, f"a mistake of bikestab itself ({problem})", DEVELOPER)
    return 0


def _check_memory() -> None:
    """Raise ScanError under a limit at which OpenBLAS, which numpy loads, would end the process by itself."""
    with suppress(ImportError):  # where there are no such limits
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if 0 <= limit < LEAST_MEMORY:
            needed = f"{LEAST_MEMORY >> 20} MB of address space"
            raise ScanError(f"not enough memory: needs {needed}, and the limit is {limit >> 20} MB")


def _tell(code: int, message: str, hint: str = "") -> int:
    tell_error(message, hint)
    return code


def _drop_output() -> None:
    """Let what is still buffered for stdout go nowhere, where it fails no second time."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
