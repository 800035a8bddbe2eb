"""Impacts by a random generator, for tools/sample_impacts: shapes, materials, speeds, contact laws, damage, spins, levels and stages
in combinations that nobody has thought of. Coarse, with bodies of 3 to 20 cells, so that each takes seconds. A number gives the
same case for ever, as long as this file stays as it is.
"""

import random

METALS = ("aluminium/6061-t6", "copper/ofhc-johnson-cook", "steel/4340", "tantalum/steinberg", "titanium/ti-6al-4v-johnson-cook",
          "tungsten-alloy/johnson-cook", "lead/pure", "magnesium/az31b", "iron/armco", "gold/pure", "aluminium/6061-t6-steinberg",
          "copper/steinberg")
OTHERS = ("polymer/pmma", "polymer/nylon", "polymer/ptfe", "ice/water", "water/liquid", "rock/granite", "alumina/ad-995",
          "alumina/99.5-johnson-holmquist", "copper/pressed-powder")
TENSION = {  # GPa at which materials of that folder break: round numbers, no data of these materials
    "aluminium": 1.0, "copper": 1.5, "steel": 2.5, "iron": 2.0, "tantalum": 5.0, "tungsten": 1.5, "tungsten-alloy": 1.5, "lead": 0.5,
    "titanium": 3.0, "magnesium": 0.8, "gold": 1.5, "platinum": 2.0, "polymer": 0.15, "alumina": 0.3, "ice": 0.01, "rock": 0.1,
    "water": 0.05, "molybdenum": 2.0, "beryllium": 1.0, "boron-carbide": 0.3, "silicon-carbide": 0.5, "tungsten-carbide": 1.0,
    **dict.fromkeys(("brass", "chromium", "iridium", "lithium-fluoride", "nickel", "niobium", "palladium", "rhenium", "silver",
                     "sodium-chloride", "thorium", "tin", "uranium", "vanadium", "zinc", "zirconium"), 1.0),
}
CELLS = {"planar": 0.25, "axisymmetric": 0.25, "3d": 0.5}  # mm
AXES = {  # extents of the domain [mm]
    "planar": {"x": (-12, 12), "y": (-8, 10)}, "axisymmetric": {"r": (0, 12), "z": (-8, 10)},
    "3d": {"x": (-8, 8), "y": (0, 8), "z": (-6, 8)},
}


def mm(value):
    return f'"{value:.4g} mm"'


def pair(low, high):
    return f"[{mm(low)}, {mm(high)}]"


def point(**axes):
    return "{ " + ", ".join(f"{a} = {mm(v)}" for a, v in axes.items()) + " }"


def ball(kind, radius, **centre):
    return f'kind = "{kind}", centre = {point(**centre)}, radius = {mm(radius)}'


def without(whole, hole):
    return f'kind = "difference", parts = [{{ {whole} }}, {{ {hole} }}]'


def planar_striker(rng, gap):
    x, y = -2, 2.5 + gap
    kite = ((-4, gap + 3), (-1, gap), (3, gap + 3), (0, gap + 5))
    return rng.choice((
        ball("disc", 2.5, x=x, y=y), without(ball("disc", 2.5, x=x, y=y), ball("disc", 1.2, x=x, y=y)),
        f'kind = "box", x = {pair(-4, 1)}, y = {pair(gap, gap + 3)}',
        'kind = "polygon", vertices = [' + ", ".join(f"[{mm(a)}, {mm(b)}]" for a, b in kite) + "]",
        f'kind = "rectangle", x = {pair(-4, 0)}, y = {pair(gap + 1.3, gap + 4.3)}, rotation = "{rng.uniform(0, 60):.3g} deg"'))


def round_striker(rng, gap):
    sphere = ball("sphere", 2.5, z=2.5 + gap)
    return rng.choice((
        sphere, without(sphere, ball("sphere", 1.2, z=2.5 + gap)), f'kind = "cylinder", radius = "2 mm", z = {pair(gap, gap + 6)}',
        f'kind = "box", r = {pair(2, 4)}, z = {pair(gap, gap + 4)}'))


def spatial_striker(rng, gap):
    return rng.choice((
        ball("sphere", 2.5, z=2.5 + gap), f'kind = "box", x = {pair(-2, 2)}, y = {pair(-2, 2)}, z = {pair(gap, gap + 4)}',
        f'kind = "cylinder", from = {point(x=1, z=gap + 1.6)}, to = {point(x=-3, z=gap + 4)}, radius = "1.5 mm"',
        f'kind = "cone", from = {point(z=gap + 5)}, to = {point(z=gap)}, radius = "2 mm"'))


def bodies(rng, geometry, periodic):
    """Shapes of striker, target and a third body that touches the target."""
    gap = rng.choice((0.05, 0.6))
    if geometry == "planar":
        wide = 20 if periodic else 10
        return (planar_striker(rng, gap), f'kind = "box", x = {pair(-wide, wide)}, y = {pair(-5, 0)}',
                rng.choice((f'kind = "box", x = {pair(-wide, wide)}, y = {pair(-7, -5)}', ball("disc", 1.5, x=5, y=1.5))))
    if geometry == "axisymmetric":
        return (round_striker(rng, gap), f'kind = "cylinder", radius = "10 mm", z = {pair(-5, 0)}',
                rng.choice((f'kind = "cylinder", radius = "10 mm", z = {pair(-7, -5)}',
                            f'kind = "torus", radius = "5 mm", tube = "1.2 mm", centre = {point(z=1.2)}')))
    slab = f'kind = "box", x = {pair(-7, 7)}, y = {pair(-7, 7)}, z = '
    return spatial_striker(rng, gap), slab + pair(-4, 0), slab + pair(-5.5, -4)


def head(rng, number, geometry, periodic, end):
    text = f'format = 1\ntitle = "Random impact {number}"\n\n[domain]\ngeometry = "{geometry}"\n'
    text += "".join(f"{a} = {pair(*extent)}\n" for a, extent in AXES[geometry].items())
    if geometry == "3d":
        text += 'boundary = { y = ["symmetry", "outflow"] }\n'
    if periodic:
        text += 'boundary = { x = "periodic" }\n'
    text += f"\n[mesh]\nfinest = {mm(CELLS[geometry])}\noffset = {rng.choice((0, 0.37, 0.5))}\nlevels = {rng.choice((1, 1, 1, 1, 2))}\n"
    text += f'\n[time]\nend = "{end:.3g} us"\n\n[method]\nstages = "{rng.choice(("three", "three", "one"))}"\n\n'
    law = rng.choice(("separable", "separable", "friction", "bonded"))
    text += f'[contact]\ndefault = "{law}"\n' + (f"friction = {rng.choice((0.1, 0.5))}\n" if law == "friction" else "")
    return text + f'\n[output]\nreport = false\nfields = {{ every = "{end:.3g} us" }}\n\n'


def material_table(name, material, breaks=True):
    """A material as a table of the case file. One that `breaks` does so by tension, unless its own file says how."""
    damage = f'damage = {{ kind = "tensile", threshold = "{TENSION[material.split("/")[0]]} GPa", exponent = 1, time = "0.02 us" }}\n'
    return f'[material.{name}]\nbase = "{material}"\n{damage if breaks and not has_damage(material) else ""}\n'


def has_damage(material):
    """Whether a material of the library has a damage of its own."""
    return "johnson-holmquist" in material


def random_material(rng, name):
    material = rng.choice(METALS if rng.random() < 0.8 else OTHERS)
    return material_table(name, material, has_damage(material) or rng.random() < 0.7)


def random_impact(number):
    """Text of the case file of impact `number`."""
    rng = random.Random(number)
    geometry = rng.choice(("planar", "planar", "axisymmetric", "axisymmetric", "3d"))
    periodic = geometry == "planar" and rng.random() < 0.2
    speed = rng.choice((50, 200, 500, 1000, 2000, 3000)) * rng.uniform(0.8, 1.2)  # m/s
    end = min(12 if geometry != "3d" else 8, max(1, 3000 / speed))  # us
    text = head(rng, number, geometry, periodic, end)
    striker, target, third = bodies(rng, geometry, periodic)
    up = "y" if geometry == "planar" else "z"
    velocity = {up: -speed}
    if geometry != "axisymmetric":
        velocity["x"] = rng.choice((0, 0, 0.6)) * speed
    way = ", ".join(f'{a} = "{v:.4g} m/s"' for a, v in velocity.items())
    text += random_material(rng, "first") + f'[body.striker]\nmaterial = "first"\nshape = {{ {striker} }}\nvelocity = {{ {way} }}\n'
    if geometry == "planar" and rng.random() < 0.2:
        text += f'spin = "{rng.uniform(-3e4, 3e4):.4g} rad/s"\nspin-centre = {point(x=-2, y=3)}\n'
    if rng.random() < 0.1:
        text += 'temperature = "500 K"\n'
    if rng.random() < 0.15:
        return text + f'\n[body.target]\nrigid = true\nshape = {{ kind = "half-space", point = {point(**{up: 0})}, normal = {{ {up} = 1 }} }}\n'
    text += "\n" + random_material(rng, "second") + f'[body.target]\nmaterial = "second"\nshape = {{ {target} }}\n'
    if rng.random() < 0.4:
        text += "\n" + random_material(rng, "third") + f'[body.third]\nmaterial = "third"\nshape = {{ {third} }}\n'
    return text
