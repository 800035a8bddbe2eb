# %% [markdown]
# # Velocity of a free surface on several meshes
# The first figure of docs/gallery.md: a 2 mm plate of aluminium strikes 15 mm of copper at 450 m/s, and a laser
# watches the rear of the copper. Dashed: the converged reference that lies beside the case.
#
# Needs matplotlib. Some seconds.

# %%
import matplotlib.pyplot as plt

import recoil

for mesh in ("0.2 mm", "0.1 mm", "0.05 mm", "0.03 mm"):
    run = recoil.run("flyer_convergence", f"runs/{mesh}", {"mesh.finest": mesh, "output.report": False}, force=True)
    plt.plot(run.gauges["rear"]["velocity"], label=mesh)
plt.plot(run.references["reference.csv"]["velocity"], "k--", label="reference")
plt.xlabel("time [us]")
plt.ylabel("velocity [m/s]")
plt.legend()
plt.savefig("flyer_figure.png")

# %% [markdown]
# How far the last mesh is off: the expectations of the case, as the program has computed them.

# %%
print(run, *run.reasons)
print(run.expectations[["value", "reference", "unit", "pass"]].to_string())
