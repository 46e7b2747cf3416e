"""Where a bicycle or motorcycle runs straight by itself: the region of stable (λ, σ, V).

The names below are public; each is imported when it is first used, so that ``import bikestab`` takes no time.
"""

__version__ = "0.1.0"

TYPE_CHECKING = False  # type checkers take it for True; typing's own costs more than all of this
if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.design.sensitivity import Sensitivity, sensitivity
    from bikestab.errors import BikestabError, InputError, ScanError
    from bikestab.pipeline import Scan, open_volume, scan
    from bikestab.region.first_sigma import FirstSigma, first_sigma
    from bikestab.speeds import KINDS, REASONS, Intervals
    from bikestab.stability import eigenvalues, growth_rate, modes, stable, stable_intervals
    from bikestab.volume import Volume

_HOME = {  # module → public names
    "bicycle": ("Bicycle",),
    "design.sensitivity": ("Sensitivity", "sensitivity"),
    "errors": ("BikestabError", "InputError", "ScanError"),
    "pipeline": ("Scan", "open_volume", "scan"),
    "region.first_sigma": ("FirstSigma", "first_sigma"),
    "speeds": ("KINDS", "REASONS", "Intervals"),
    "stability": ("eigenvalues", "growth_rate", "modes", "stable", "stable_intervals"),
    "volume": ("Volume",),
}
__all__ = [
    "KINDS",
    "REASONS",
    "Bicycle",
    "BikestabError",
    "FirstSigma",
    "InputError",
    "Intervals",
    "Scan",
    "ScanError",
    "Sensitivity",
    "Volume",
    "eigenvalues",
    "first_sigma",
    "growth_rate",
    "modes",
    "open_volume",
    "scan",
    "sensitivity",
    "stable",
    "stable_intervals",
]


if not TYPE_CHECKING:
    import sys

    class _Package(type(sys)):
        """Keeps the functions scan and modes when the modules of these names are imported."""

        def __setattr__(self, name, value):
            if not (name in __all__ and isinstance(value, type(sys))):
                super().__setattr__(name, value)

    sys.modules[__name__].__class__ = _Package

    def __getattr__(name):
        for module, names in _HOME.items():
            if name in names:
                from importlib import import_module

                value = globals()[name] = getattr(import_module(f"bikestab.{module}"), name)
                return value
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def __dir__():
        return [*__all__, "__version__"]
