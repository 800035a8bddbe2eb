# %% [markdown]
# # How the answer depends on the velocity of the flyer
# One case, several velocities, two runs at a time; the table has a row for each run. The keys are those of the case
# file, the quantities those that its [expect] understands.

# %%
import recoil

table = recoil.sweep(
    "flyer_al_cu",
    {"body.flyer.velocity.x": ["150 m/s", "300 m/s", "450 m/s", "600 m/s"]},
    {
        "stress": "gauge.impact.traction.mean@0.2us..0.5us",
        "opens": "contact.flyer-target.opens",
        "peak": "gauge.rear.velocity.peak",
        "rebound": lambda run: -run.value("gauge.flyer.velocity.x.last"),
    },
    out="runs/velocities",
    overrides={"mesh.finest": "0.1 mm", "output.report": False},
    processes=2,
    force=True,
)
print(table.drop(columns="folder"))

# %% [markdown]
# The stress at the contact over that of sound waves in fluids of the same impedance. It is above 1: strength adds most
# at low velocities, the curved Hugoniots at high ones.

# %%
materials = recoil.open(table["folder"][0]).materials


def impedance(name):
    """Density times bulk speed of sound, GPa s/m; values of a resolved case are in SI."""
    eos = materials[name]["eos"]
    return float(eos["density"].split()[0]) * float(eos["c0"].split()[0]) * 1e-9


flyer, target = impedance("aluminium/6061-t6"), impedance("copper/seed")
table["acoustic"] = -table["body.flyer.velocity.x"] * flyer * target / (flyer + target)
table["ratio"] = table["stress"] / table["acoustic"]
print(table[["body.flyer.velocity.x", "stress", "acoustic", "ratio"]])
