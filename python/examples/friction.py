"""How far does a mass slide along a falling beam, depending on its friction? A sweep, and what it means.

    python3 python/examples/friction.py [FIGURE.svg]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import vlbeam

scene = vlbeam.scene("falling_beam")
scene["beam"]["elements"] = 10
scene["sliding_mass"]["friction"] = {"coefficient": 0.1}

# Every case runs on a thread of its own; a case that fails is marked, and costs itself only.
coefficients = [0.0, 0.05, 0.1, 0.2, 0.4, 0.8]
cases = vlbeam.sweep(
    scene,
    {"/sliding_mass/friction/coefficient": coefficients},
    quantities=["joint_position", "energy.dissipated"],
)
for mu, x, lost, status in zip(coefficients, cases.joint_position, cases["energy.dissipated"], cases.status):
    print(f"coefficient {mu:4.2f}: {status}, the mass is at {x:.3f} m, friction took {lost:.3f} J")

# More friction, less way; and without it nothing is dissipated.
assert (cases.status == "completed").all()
assert (np.diff(cases.joint_position) < 0).all()
assert cases["energy.dissipated"][0] == 0 and (cases["energy.dissipated"][1:] > 0).all()

figure, axis = plt.subplots(layout="constrained")
axis.plot(coefficients, cases.joint_position, "o-")
axis.set(xlabel="coefficient of friction", ylabel="way of the mass at 0.5 s (m)", title=scene["title"])
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "friction.svg")
