"""Eigenvalues of three machines against speed, on axes of one's own.

Left the growth of each motion, right how fast it oscillates. Modes keep their names along the speed.
"""

import matplotlib.pyplot as plt
import numpy as np

import bikestab as bs

machines = {
    "meijaard2007": bs.Bicycle.preset("meijaard2007"),
    "with a rider of 110 kg": bs.Bicycle.preset("meijaard2007").replaced({"mB": 110}),
    "kooijman2011": bs.Bicycle.preset("kooijman2011"),
}
V = np.linspace(0, 10, 401)
colours = {"weave": "tab:blue", "capsize": "tab:orange", "castering": "tab:green"}

figure, axes = plt.subplots(len(machines), 2, sharex=True, layout="constrained", figsize=(8, 8))
for (name, bike), (growth, frequency) in zip(machines.items(), axes, strict=True):
    found = bs.modes(bike, V)
    for branch, colour in zip((0, 2, 3), colours.values(), strict=True):  # 1 is the other half of weave
        growth.plot(V, found.eigenvalues[branch].real, color=colour)
    frequency.plot(V, np.abs(found.eigenvalues[0].imag) / (2 * np.pi), color=colours["weave"])

    intervals = bs.stable_intervals(bike)
    for V1, V2 in zip(intervals.V1, intervals.V2, strict=True):
        growth.axvspan(V1, min(V2, V[-1]), color="0.9")
        print(f"{name}: stable from {V1:.3f} to {V2:.3f} m/s")
    growth.axhline(0, color="0.5", linewidth=0.8)
    growth.set(title=name, ylabel="growth rate [1/s]", ylim=(-10, 6))
    frequency.set(ylabel="weave [Hz]")
for ax in axes[-1]:
    ax.set(xlabel="V [m/s]", xlim=(V[0], V[-1]))
figure.legend(
    [plt.Line2D([], [], color=c) for c in colours.values()], colours, loc="outside upper center", ncols=3
)
figure.savefig("three_bicycles.png", dpi=120)
