"""A machine's stable speeds, eigenvalues and modes: the library's answers, asked of a Bicycle.

The functions that answer for tables are in ``speeds``, ``spectrum``, ``routh`` and ``modes``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab import routh
from bikestab.arguments import Given, table_and_speeds
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.model import Floats, Model
from bikestab.speeds import Intervals, intervals_of

if TYPE_CHECKING:
    from bikestab.modes import Modes


def stable_intervals(
    bicycle: Bicycle, lam: Given = None, sigma: Given = None, *,
    model: Model = "refined", delta: float | None = None,
) -> Intervals:  # fmt: skip
    """Every interval of speeds at which the machine runs straight by itself.

    Parameters
    ----------
    bicycle : Bicycle
        The machine.
    lam, sigma : array_like, optional
        Tilt of the steering axis [rad] and trail divided by the wheelbase [1], which broadcast together to
        ``shape``; text with a unit, such as ``"18deg"``, is understood too. By default the bicycle's own.
    model : {"refined", "unrefined"}
        The paper's equations, or those before it without its second-order gravity terms.
    delta : float, optional
        Viscous damping of the steering [kg m²/s]; by default the bicycle's own.

    Returns
    -------
    Intervals
        ``V1``, ``V2`` [m/s] and what happens there, ``lower``, ``upper``, as indices into ``KINDS``; each of
        shape ``(*shape, interval)``, NaN and ``"none"`` behind a design's last; ``V2`` may be inf. The true
        ends are within ``V1_error``, ``V2_error`` [m/s] of these. ``number`` counts a design's intervals.

    Raises
    ------
    InputError
        For a missing design, or what the equations cannot use; its ``key`` names the argument.

    Notes
    -----
    From (2.2) of Dikarev, Dikareva and Fufaev (1981): an interval ends where hurwitz3 = 0 (``weave``) or
    p0 = 0 (``capsize``), at V = 0 (``rest``), or never (``unbounded``). No grid is involved.

    Examples
    --------
    >>> import bikestab as bs
    >>> bike = bs.Bicycle.preset("meijaard2007")
    >>> own = bs.stable_intervals(bike)
    >>> own.V1.round(6), own.V2.round(6), bs.KINDS[own.lower[0]], bs.KINDS[own.upper[0]]
    (array([4.292383]), array([6.024262]), 'weave', 'capsize')
    >>> bs.stable_intervals(bike, lam=[[0.1], [0.2], [0.3]], sigma=[0.02, 0.05, 0.1]).number
    array([[0, 0, 0],
           [1, 1, 1],
           [1, 1, 1]])
    """
    table, _ = table_and_speeds(bicycle, 1.0, lam, sigma, model, delta)  # any speed: the table has all
    return intervals_of(table)


def eigenvalues(
    bicycle: Bicycle, V: ArrayLike, lam: Given = None, sigma: Given = None, *,
    model: Model = "refined", delta: float | None = None,
) -> NDArray[np.complex128]:  # fmt: skip
    """The four eigenvalues of the motion, in no particular order; ``modes`` follows and names them.

    Parameters
    ----------
    bicycle : Bicycle
        The machine.
    V : array_like
        Speeds [m/s], not negative, or text such as ``"18km/h"``.
    lam, sigma, model, delta
        As in ``stable_intervals``; ``lam``, ``sigma`` and ``V`` broadcast together to ``shape``.

    Returns
    -------
    ndarray of complex
        Eigenvalues [1/s], shape ``(4, *shape)``. NaN where the mass matrix is singular.

    Raises
    ------
    InputError
        As ``stable_intervals``, and for a speed that is negative or not finite.

    Notes
    -----
    Roots of (2.1) of Dikarev, Dikareva and Fufaev (1981), as polynomial in real time. Where two of them meet,
    rounding of the parameters moves them by about its square root.

    Examples
    --------
    >>> import bikestab as bs
    >>> import numpy as np
    >>> bike = bs.Bicycle.preset("meijaard2007")
    >>> np.sort_complex(bs.eigenvalues(bike, 5.0)).round(6)
    array([-14.07839 +0.j      ,  -0.775342-4.464868j,  -0.775342+4.464868j,
            -0.322866+0.j      ])
    >>> bs.eigenvalues(bike, np.linspace(0, 10, 101), lam=[[0.3], [0.4]]).shape
    (4, 2, 101)
    """
    from bikestab.spectrum import eigenvalues_of  # stable speeds need none of it

    table, speeds = table_and_speeds(bicycle, V, lam, sigma, model, delta)
    return eigenvalues_of(table, speeds)


def growth_rate(
    bicycle: Bicycle, V: ArrayLike, lam: Given = None, sigma: Given = None, *,
    model: Model = "refined", delta: float | None = None,
) -> Floats:  # fmt: skip
    """The largest real part of the eigenvalues: how fast the fastest growing motion grows.

    Parameters
    ----------
    bicycle, V, lam, sigma, model, delta
        As in ``eigenvalues``.

    Returns
    -------
    ndarray of float
        Growth rate [1/s], of the shape that ``lam``, ``sigma`` and ``V`` have together; negative where the
        motion dies out. inf where the mass matrix is singular, since an eigenvalue is infinite there.

    Raises
    ------
    InputError
        As ``eigenvalues``.

    Notes
    -----
    The largest real part of the roots of (2.1) of Dikarev, Dikareva and Fufaev (1981).

    Examples
    --------
    >>> import bikestab as bs
    >>> bike = bs.Bicycle.preset("meijaard2007")
    >>> bs.growth_rate(bike, [3, 5, 7]).round(6)
    array([ 1.706756, -0.322866,  0.102682])
    """
    from bikestab.spectrum import growth_rate_of  # stable speeds need none of it

    table, speeds = table_and_speeds(bicycle, V, lam, sigma, model, delta)
    return growth_rate_of(table, speeds)


def stable(
    bicycle: Bicycle, V: ArrayLike, lam: Given = None, sigma: Given = None, *,
    model: Model = "refined", delta: float | None = None,
) -> NDArray[np.bool_]:  # fmt: skip
    """Whether every small disturbance of rectilinear motion dies out: within an interval V1 < V < V2.

    Parameters
    ----------
    bicycle, V, lam, sigma, model, delta
        As in ``eigenvalues``.

    Returns
    -------
    ndarray of bool
        Of the shape that ``lam``, ``sigma`` and ``V`` have together.

    Raises
    ------
    InputError
        As ``eigenvalues``.

    Notes
    -----
    All six conditions (2.2) of Dikarev, Dikareva and Fufaev (1981) hold. Where V > 0 the exact ends of
    ``stable_intervals`` say so, and at rest the conditions themselves.

    Examples
    --------
    >>> import bikestab as bs
    >>> bike = bs.Bicycle.preset("meijaard2007")
    >>> bs.stable(bike, [3, 5, 7])
    array([False,  True, False])
    >>> bool(bs.stable(bike, "18km/h", lam="20deg"))
    True
    """
    table, speeds = table_and_speeds(bicycle, V, lam, sigma, model, delta)
    found = intervals_of(table)
    inside = (speeds == 0) & routh.stable(table.value, 0.0)
    for V1, V2 in zip(np.moveaxis(found.V1, -1, 0), np.moveaxis(found.V2, -1, 0), strict=True):
        inside |= (speeds > V1) & (speeds < V2)
    return inside


def modes(
    bicycle: Bicycle, V: ArrayLike, lam: float | str | None = None, sigma: float | str | None = None, *,
    model: Model = "refined", delta: float | None = None,
) -> Modes:  # fmt: skip
    """The eigenvalues of one design, followed continuously along the speed and named.

    Parameters
    ----------
    bicycle, V, lam, sigma, model, delta
        As in ``eigenvalues``, but one ``lam`` and one ``sigma``; ``V`` has the shape (n,), in any order.

    Returns
    -------
    Modes
        ``eigenvalues`` [1/s] and ``names``, both (4, n): two rows of weave, one of capsize, one of castering
        as they are at high speeds; what crosses at a weave or capsize end has that name (``modenames``);
        and ``coalescences`` [m/s], where two of them go from real to complex or back.

    Raises
    ------
    InputError
        As ``eigenvalues``, for several designs, and where the mass matrix is singular.

    Notes
    -----
    Events are roots of the discriminant of (2.1) of Dikarev, Dikareva and Fufaev (1981), found with Sturm's
    theorem in exact arithmetic; no step along the speed is taken.

    Examples
    --------
    >>> import bikestab as bs
    >>> found = bs.modes(bs.Bicycle.preset("meijaard2007"), [5.0, 10.0])
    >>> for name, s in zip(found.names[:, 0], found.eigenvalues[:, 0].round(6)):
    ...     print(name, s)
    weave (-0.775342+4.464868j)
    weave (-0.775342-4.464868j)
    capsize (-0.322866+0j)
    castering (-14.07839+0j)
    """
    from bikestab.modes import follow  # exact arithmetic, which nothing else here needs

    table, speeds = table_and_speeds(bicycle, V, lam, sigma, model, delta)
    if table.value.ndim > 2 or speeds.ndim > 1:
        key = "V" if table.value.ndim == 2 else "lam, sigma"
        raise InputError("modes are followed for one design along one row of speeds", key=(key,))
    return follow(table, speeds)
