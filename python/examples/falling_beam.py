"""A mass slides along a beam that falls: shapes, energy, and how far the answer can be trusted.

    python3 python/examples/falling_beam.py [FIGURE.svg]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import vlbeam

# A scene is a dictionary whose keys are attributes too; this one comes with the package. An implicit integrator takes fewer and
# longer steps, and goes well with velocities that are restored when elements merge. The whole shape is kept at seven times.
scene = vlbeam.scene("falling_beam")
scene.integrator.generalized_alpha(step=5e-4)
scene.length_control.velocities = "conservative"
scene.output = {"interval": 0.005, "configurations": [0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.5]}

r = vlbeam.run(scene)

# Samples are numpy arrays: the mass has slid from 0.1 m to 0.71 m.
print(f"{r.status}: {r.t.size} samples, the mass slid from {r.joint_position[0]:.2f} m to {r.joint_position[-1]:.4f} m")
assert abs(r.joint_position[-1] - 0.7125) < 2e-3

# What the energy changes by is small against the largest kinetic energy.
change = np.abs(r.energy.total - r.energy.total[0]).max() / r.energy.kinetic.max()
print(f"the total energy changes by {change:.1e} of the largest kinetic energy")
assert change < 1e-3

# How far can that be trusted? This refines mesh, time and quadrature until the millimetre is sure.
answer = vlbeam.converge(scene, "joint_position", 1e-3)
print(f"joint position at the end: {answer.answer:.5f} m, known to {answer.uncertainty:.1e} m")
assert answer.reached and abs(answer.answer - 0.71248) < 1e-3

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
r.plot(ax=left)
r.plot("energy", ax=right)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "falling_beam.svg")
