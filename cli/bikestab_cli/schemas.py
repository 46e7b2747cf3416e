"""The JSON Schema of what each command prints with --json; docs/json.md is made from them."""

from __future__ import annotations

from bikestab_cli.compare_schema import COMPARE, WITHIN
from bikestab_cli.eigen_schema import EIGEN
from bikestab_cli.proof_schema import CERTIFY, LARGEST, PAIR
from bikestab_cli.shapes import (
    DESIGN,
    ENDS,
    INTERVAL,
    INTERVALS,
    MAYBE_KIND,
    MODEL,
    NULL,
    NUMBERS,
    OVER,
    TEXTS,
    VERDICT,
    Schema,
    answer,
    either,
    flag,
    maybe,
    named,
    num,
    of_machines,
    or_problems,
    record,
    some,
    whole,
    words,
)

_MAYBE_PAIR = {"anyOf": [PAIR, NULL]}
_NEAREST = record(
    "what would help",
    sigma_min=maybe("the nearest larger σ with a stable speed"), sigma_max=maybe("the nearest smaller"),
    lam_min=maybe("the nearest λ with one, from here [rad]"), lam_max=maybe("to here [rad]"),
    V=maybe("the speed at which the motion grows least [m/s]"), growth_rate=maybe("how fast there [1/s]"),
)  # fmt: skip
_END = record(
    "an end of the stable speeds [m/s]",
    own=maybe("the machine's own"), linear=maybe("its standard deviation by the linear rule"),
    sampled=maybe("by drawn machines"), low=maybe("the lowest twentieth of the machines ends here"),
    median=maybe("their median"), high=maybe("the highest twentieth begins here"),
)  # fmt: skip
_SPREAD = record(
    "how far the stable speeds are known, with --sd",
    deviations=named(NUMBERS, "standard deviations by parameter"),
    samples=whole("drawn machines that can exist"),
    refused=whole("drawn ones that cannot"), exists=num("share of them that are stable somewhere"),
    unbounded=num("share of them without an upper limit"), V1=_END, V2=_END,
    reasons=some(TEXTS, "why the linear rule is wrong; empty where it is right"),
)  # fmt: skip
_JUDGED = either(
    record(
        "a design, one of its intervals, and its growth rate", ("over",), over=OVER,
        **DESIGN, V1=maybe("lower end [m/s]; null: nothing is stable"),
        V2=maybe("upper end; null: unbounded"),
        lower=MAYBE_KIND, upper=MAYBE_KIND, width=num("of the interval up to V_max [m/s]"),
        growth_rate=maybe("where it is judged [1/s]; null: infinite"),
        V=num("the speed it is judged at [m/s]"),
        at=words("where in the box it lies"),
    ),
    NULL, text="null: there is none",
)  # fmt: skip
_ROW = record(
    "one parameter's effect",
    name=words("parameter"), value=maybe("in SI units"), unit=words("of the value"),
    meaning=words("in words"),
    notation=flag("whether it is one of the bicycle's notation"), dV1=maybe("dV1/dp"), dV2=maybe("dV2/dp"),
    elasticity_V1=maybe("per cent for one per cent"), elasticity_V2=maybe("the same for V2"),
    change=maybe("by how much it alone must change for V1 to fall by 0.1 m/s; null: none found, or g"),
)  # fmt: skip
_TRIED = record(
    "the widest interval with other values", what=words("in words"), values=named(NUMBERS, "the values"),
    interval=either(INTERVAL, NULL, text="null: none is stable"),
)  # fmt: skip
_BEST = record(
    "the lowest growth rate", value=maybe("[1/s]"), V=num("at this speed [m/s]"),
    kind=words("smooth, crossing, meeting or end"), slope=named(maybe(""), "its derivatives by parameter"),
)  # fmt: skip
_FIRST = record(
    "the smallest σ with a stable speed at this λ", value=maybe("null: none, or none that begins"),
    V=maybe("where the interval opens [m/s]; null: at infinity"),
    kind={"type": ["string", "null"], "description": "the curve that it is on, as in export --skeleton"},
    slope=named(maybe(""), "its derivatives by parameter; empty: none"),
    reason=words("why there is none; else empty"),
)  # fmt: skip
_ROBUST = record(
    "the design with the largest ball of stable machines", design=_JUDGED,
    radius=num("of the ball, in standard deviations"),
    deviations=named(NUMBERS, "these, by parameter, in SI units"),
    nearest=named(NUMBERS, "the nearest machine that is not stable, by parameter"),
)  # fmt: skip
_SPEED_OR_UNBOUNDED = ({"const": "unbounded"}, NUMBERS)
_EDGE = record(
    "an end of stable speeds", name={"enum": ["V1", "V2"], "description": "which"},
    expected=either(*_SPEED_OR_UNBOUNDED, text="[m/s]"),
    found=either(*_SPEED_OR_UNBOUNDED, NULL, text="[m/s]; null: no stable speed"),
    difference=maybe("found - expected [m/s]; null: no number"), percent=maybe("of what is expected"),
    tolerance=maybe("how large it may be [m/s]; null where unbounded is expected"),
    within=flag("whether it is as expected"),
)  # fmt: skip
_AXIS = record(
    "an axis", first=num("first value"), last=num("last value"), num=whole("how many"),
    unit=words("as in the file"),
    uniform=flag("whether the steps are equal"),
)  # fmt: skip
_MACHINE = record(
    "a machine", set=named(NUMBERS, "its values of the sweep"),
    designs_with_a_stable_speed=whole("of the grid"),
    stable_points={"type": ["integer", "null"], "description": "of the grid; null if that is not stored"},
    at=named(NUMBERS, "the design of the grid nearest to its own, of which the quantiles are"),
    quantiles=some(
        record(
            "of an ensemble's stable machines", quantile=num("share"),
            V1=maybe("[m/s]; null: none is stable"),
            V2=maybe("[m/s]; null: unbounded, or none"),
        ),
        "empty without an ensemble",
    ),
)  # fmt: skip
SCHEMAS: dict[str, Schema] = {
    "vrange": or_problems(
        of_machines(
            "a design", ("spread", "over"), over=OVER, **DESIGN, intervals=INTERVALS, **VERDICT,
            nearest=either(_NEAREST, NULL, text="null where there is a stable speed"), spread=_SPREAD,
        ),
        "nearest",
    ),
    "eigen": EIGEN,
    "design": or_problems(
        of_machines(
            "a machine's search", ("most_robust", "certified"),
            searched={
                **record(
                    "what was asked, the ends of --over by parameter", ("lam", "sigma", "trail", "offset"),
                    lam=PAIR, sigma=PAIR, trail=_MAYBE_PAIR, offset=_MAYBE_PAIR,
                    V_max=num("intervals count up to here [m/s]"), judged=_MAYBE_PAIR, stable=_MAYBE_PAIR,
                ),
                "additionalProperties": PAIR,
            },
            own=_JUDGED, widest=_JUDGED, lowest_V1=_JUDGED, fastest_decay=_JUDGED,
            pareto=some(_JUDGED, "from the widest to the fastest; empty with --free"), closest=_JUDGED,
            most_robust=either(_ROBUST, NULL, text="with --free; null without --sd"),
            certified=LARGEST,
        )
    ),
    "sensitivity": or_problems(
        of_machines(
            "a design", **DESIGN, hold={"enum": ["trail", "offset", "sigma"], "description": "what stays"},
            best=_BEST, sigma_min=_FIRST, tried=some(_TRIED, "computed anew, not by derivatives"),
            intervals=some(
                record("an interval", **ENDS, parameters=some(_ROW, "the largest effects first")),
                "ascending",
            ),
            spread=either(_SPREAD, NULL, text="null without standard deviations"),
        )
    ),
    "check": answer(
        either(
            record(
                "one expectation", ("over",), config=words("the file"), line=whole("of the file"),
                bicycle=words("its bicycle"),
                model=MODEL, over=named(NUMBERS, "other parameters' values, in SI units"), **DESIGN,
                expected=record(
                    "as in the config", ("V1", "V2", "within", "stable"), V1=num("[m/s]"),
                    V2=either(NUMBERS, {"const": "unbounded"}, text="[m/s]"), within=WITHIN,
                    stable={"const": "never"},
                ),
                intervals=INTERVALS,
                nearest={"type": ["integer", "null"],
                "description": "the number, from 0, of the interval that comes nearest; null: none"},
                edges=some(_EDGE, "the ends that are expected, as that interval has them"),
                holds=flag("whether it is so"), problem=words("what is not, in words; empty where it is so"),
            ),
            record(
                "a file that cannot be used", config=words("the file"), error=words("why"),
                mistakes=some(TEXTS, "all that is wrong, each with file, line, key and what is allowed"),
            ),
            record(
                "an expectation that cannot be used", config=words("the file"), line=whole("of the file"),
                bicycle=words("its bicycle"), model=MODEL, error=words("why"),
                mistakes=some(TEXTS, "all that is wrong with it, as above"),
            ),
            text="an expectation, or a file or an expectation that cannot be used",
        )
    ),
    "compare": COMPARE,
    "scan": answer(
        record(
            "a config", config=words("the file"), bicycle=words("its bicycle"),
            volume=words("the file written"),
            pictures=some(TEXTS, "files drawn"),
            report={"type": ["string", "null"], "description": "the page written; null: none is asked for"},
            computed=flag("false: it was complete already"),
            points=whole("of the grid"), stable_points=whole("of these"),
            largest_boundary_difference=maybe("between conditions' signs and exact speeds [m/s]"),
            bracketed_zeros={"type": ["integer", "null"], "description": "found by scipy too"},
            largest_bracketed_difference=maybe("between these and the exact speeds [m/s]"),
            warnings=some(TEXTS, "what no rigid body can have"),
        )
    ),
    "info": answer(
        record(
            "a volume", volume=words("the file"), title=words("its title"), bicycle=words("its bicycle"),
            model=MODEL,
            delta=num("steering damping [kg m²/s]"), fields=some(TEXTS, "what it holds over the grid"),
            ensemble_samples=whole("machines drawn; 0: no ensemble"),
            drawn=named(
                named(some(NUMBERS, "its numbers, as in a config, in SI units"), "the kind of distribution"),
                "the ensemble's parameters; empty without one, or if a file has them that the config names",
            ),
            points=whole("of the grid"),
            stable_points=whole("of these"), designs=whole("of the grid"),
            designs_with_a_stable_speed=whole("of these"), designs_with_several_intervals=whole("of these"),
            designs_stable_without_upper_limit=whole("of these"),
            designs_marginal={"type": ["integer", "null"], "description": "null in earlier volumes"},
            largest_boundary_difference=num("between conditions' signs and exact speeds [m/s]"),
            largest_bracketed_difference=maybe("between scipy's zeros and these"),
            bikestab_version=words("that wrote it"), config_sha256=words("what is computed, as a hash"),
            sweep=named(some(NUMBERS, "values"), "the sweep's axes"), axes=named(_AXIS, "the grid's"),
            machines=some(_MACHINE, "those of a sweep; one of an ensemble alone; else empty"),
            warnings=some(TEXTS, "what no rigid body can have"),
        )
    ),
    "bicycles": answer(
        {
            "type": "object", "description": "a bicycle: its parameters in the paper's notation, in SI units",
            "properties": {"name": TEXTS, "source": TEXTS, "warnings": some(TEXTS,
            "what no rigid body can have")},
            "additionalProperties": maybe(""), "required": ["name", "source", "warnings"],
        }
    ),
    "certify": CERTIFY,
}  # fmt: skip
