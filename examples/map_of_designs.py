"""A map: how wide the interval of stable speeds is over head angle and trail.

One call answers for every design of an array; 20 000 of them take a fraction of a second.
"""

import matplotlib.pyplot as plt
import numpy as np

import bikestab as bs

bike = bs.Bicycle.preset("meijaard2007")  # or bs.Bicycle.load("mine.yaml")

head_angle = np.linspace(60, 85, 126)  # °
trail = np.linspace(0, 0.15, 151)  # m, along the ground

tilt = np.deg2rad(90 - head_angle)[:, np.newaxis]
found = bs.stable_intervals(bike, lam=tilt, sigma=trail / bike.c)  # V1, V2: (head angle, trail, interval)

fastest = 15.0  # m/s; what lies above counts for nothing
width = np.nansum(np.minimum(found.V2, fastest) - np.minimum(found.V1, fastest), axis=-1)
i, j = np.unravel_index(width.argmax(), width.shape)
stable = np.mean(found.number > 0)
print(f"{100 * stable:.0f} % of {width.size} designs of {bike.name} have a stable speed")
print(
    f"widest: {width[i, j]:.2f} m/s, at a head angle of {head_angle[i]:.1f}° and a trail of {trail[j]:.3f} m"
)

figure, ax = plt.subplots(layout="constrained")
colours = ax.pcolormesh(trail, head_angle, np.where(width > 0, width, np.nan), cmap="viridis")
ax.contour(trail, head_angle, found.V1[..., 0], levels=np.arange(2, 9), colors="white", linewidths=0.8)
figure.colorbar(colours, label=f"width of the stable interval up to {fastest:g} m/s [m/s]")
ax.plot(bike.sigma * bike.c, 90 - np.rad2deg(bike.lam), "o", color="tab:red", label="as it is")
ax.set(xlabel="trail [m]", ylabel="head angle [°]", title=f"{bike.name}; white lines: V1 = 2, 3, … 8 m/s")
ax.legend()
figure.savefig("map_of_designs.png", dpi=120)
