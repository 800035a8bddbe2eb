# %% [markdown]
# # Flow stress of copper over strain, at three rates
# A thin bar of OFHC copper (Johnson and Cook) is pulled; without heat conduction, so that it softens where it is fast.
#
# Needs matplotlib and the compiled module of materials. Less than a second.

# %%
import matplotlib.pyplot as plt

import recoil

copper = recoil.Material("copper/ofhc-johnson-cook")
paths = {rate: copper.uniaxial_stress(0.4, rate) for rate in ("1/s", "1e3/s", "1e5/s")}
for rate, path in paths.items():
    plt.plot(path["strain"], path["stress.xx"], label=rate)
plt.xlabel("logarithmic strain")
plt.ylabel("stress [GPa]")
plt.legend()
plt.savefig("stress_and_strain.png")

# %% [markdown]
# How warm it has become:

# %%
for rate, path in paths.items():
    print(rate, round(path["temperature"][-1]), "K")
