"""A volume in xarray: scan a grid once, then ask it questions by name.

Needs the extra ``xarray`` (pip install "bikestab[xarray]"), and the folder ``configs`` of the project.
"""

import bikestab as bs

done = bs.scan("configs/quick.yaml")  # is kept: running this again computes nothing
with done.open() as volume, volume.to_xarray() as data:
    print(f"{data.title}: axes {dict(data.growth_rate.sizes)}")

    # how much of the plane of designs is stable at each speed?
    share = data.stable.mean(["lam", "sigma"])
    best = share.idxmax("V")
    print(f"most designs are stable at {float(best):.1f} m/s: {100 * float(share.max()):.0f} % of them")

    # the design that decays fastest there
    plane = data.growth_rate.sel(V=best)
    at = plane.argmin(["lam", "sigma"])
    growth = float(plane.isel(at))
    lam, sigma = float(data.lam[at["lam"]]), float(data.sigma[at["sigma"]])
    print(f"fastest decay there: {growth:.2f} 1/s, at λ = {lam:.2f} rad and σ = {sigma:.3f}")

    # its exact stable speeds
    for V1, V2 in zip(data.V1.isel(at).values, data.V2.isel(at).values, strict=True):
        print(f"stable from {V1:.3f} to {V2:.3f} m/s")
