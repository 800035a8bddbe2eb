# %% [markdown]
# # Fields at a time
# Round plates in contact (axisymmetric): pressure at 1 us, with the surfaces of both bodies.
#
# Needs matplotlib.

# %%
import matplotlib.pyplot as plt
import numpy

import recoil

run = recoil.run(
    "flyer_axisymmetric",
    "runs/plates",
    {"mesh.finest": "0.4 mm", "time.end": "1 us", "output.fields": {"every": "0.5 us"}, "output.report": False},
    force=True,
)
print(run.fields)

# %% [markdown]
# One value for each cell that holds matter, at the middles of the cells. `numpy.nan` is where there is too little.

# %%
fields = run.at("1 us")
pressure = fields["pressure"]
r, z = fields.coordinates.values()
most = numpy.nanargmax(pressure)
print(f"largest pressure {pressure[most]:.2f} {fields.units['pressure']} at r = {r[most]:.2f}, z = {z[most]:.2f} mm")

# %% [markdown]
# On a full grid, for pictures. Level sets are distances to a surface, negative inside; their zeros are the surfaces.

# %%
grid = fields.grid()
image = plt.pcolormesh(grid.edges["r"], grid.edges["z"], grid["pressure"].T, cmap="viridis")
plt.colorbar(image, label=f"pressure [{fields.units['pressure']}]")
for body in run.bodies:
    plt.contour(grid.centres["r"], grid.centres["z"], grid[f"level_set_{body}"].T, [0], colors="k")
plt.xlabel("r [mm]")
plt.ylabel("z [mm]")
plt.axis("equal")
plt.title(f"{run.title}, {fields.time:.3g} us")
plt.savefig("fields_at_a_time.png")
