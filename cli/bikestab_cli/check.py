"""bikestab check: whether the expectations of configs hold."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from time import perf_counter

import click
from bikestab_cli.check_words import Checked, failures, outcome_records, outcome_table, suite_of, verdict
from bikestab_cli.options import FILE, NAME, check_files, json_option, of_file
from bikestab_cli.output import print_json, tell, tell_file
from bikestab_cli.streams import tell_error

from bikestab.errors import BikestabError, InputError


@click.command("check")
@click.argument("configs", type=NAME, nargs=-1, required=True, metavar="CONFIG...")
@click.option("--junit", type=FILE, metavar="FILE", help="Write the results as JUnit XML, for CI servers.")
@json_option
def command(configs: tuple[str, ...], junit: str | None, as_json: bool) -> None:
    """Compare what configs expect with the exact speeds.

    For CI. Reads their 'expect' entries; needs no scan, and no grid in the file: only 'bicycle' and 'expect'.
    An entry with V1 and/or V2 holds if one of the stable intervals has these ends within 'within', a speed
    or per cent of it ('1%'); 'stable: never' if there is none. Without lam and sigma it is of the bicycle's
    own design; any other parameters, such as mB: 85 or delta: 1, may have values of their own.

    Every file is looked at, once, and every entry. Exit code 0 if all hold, 1 if one does not, 2 if a file
    or an entry cannot be used.

    \b
    Examples:
      bikestab check configs/dikarev1981.yaml configs/meijaard2007.yaml
      bikestab check configs/quick.yaml configs/sharp1971.yaml --junit results.xml
      bikestab check configs/quick.yaml --json
    """
    check_files(junit)
    once: dict[Path, str] = {}
    for name in configs:  # globs may overlap
        once.setdefault(Path(name).absolute(), name)
    checked = [_checked(name) for name in once.values()]
    if junit:
        from bikestab.export.junit import save_junit

        save_junit([suite_of(each) for each in checked], junit)
    errors = [error for each in checked for error in each.errors]
    with suppress(BrokenPipeError):  # the exit code is wanted also by those who read no more
        if as_json:
            results = [record for each in checked for record in outcome_records(each)]
            print_json({"results": results, **({"files": {"junit": junit}} if junit else {})})
        else:
            if any(each.entries for each in checked):
                tell("\n".join([outcome_table(checked), *failures(checked)]), junit)
            if junit:
                tell_file(junit)
    codes = [0, *(2 if isinstance(error, InputError) else 3 for error in errors)]
    for error in errors:
        tell_error(str(error))
    failed, words = verdict(checked)
    if words:
        click.echo(words, err=True)
    click.get_current_context().exit(max(*codes, 1 if failed else 0))


def _checked(name: str) -> Checked:
    from bikestab.config.checks import checked

    start = perf_counter()
    try:
        with of_file(name):
            config, entries = checked(name)
            return Checked(name, config.machine.name, config.model, entries, None, perf_counter() - start)
    except BikestabError as error:
        return Checked(name, "", "", [], error, perf_counter() - start)
