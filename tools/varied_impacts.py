"""Impacts for tools/sample_impacts with what random_impacts.py leaves out: explosives, gases, foam, free rigid bodies, pistons,
hot and pressed bodies, implosions, stacks and heaps of bodies, thin plates, slow contacts, every model of damage, three levels,
small blocks. Coarse; a number gives the same case for ever, as long as this file and random_impacts.py stay as they are.
"""

import random

from random_impacts import ball, material_table, mm, pair, point, without

METALS = ("aluminium/6061-t6", "aluminium/2024-t351", "copper/ofhc-johnson-cook", "steel/4340", "steel/304", "iron/armco",
          "tantalum/steinberg", "titanium/ti-6al-4v", "tungsten/steinberg", "lead/pure", "nickel/200", "zinc/pure", "tin/pure")
BRITTLE = ("rock/basalt", "boron-carbide/johnson-holmquist", "silicon-carbide/sic", "polymer/polystyrene", "polymer/epoxy", "ice/water")
EXPLOSIVES = ("composition-b", "tnt", "petn", "pbx-9404", "c-4", "octol")
GASES = ("air", "argon", "helium")
DAMAGE = {
    "johnson-cook": 'kind = "johnson-cook", d1 = 0.05, d2 = 3.44, d3 = -2.12, d4 = 0.002, d5 = 0.61, melting-temperature = "1700 K"',
    "void-growth": 'kind = "void-growth", nucleation-stress = "0.3 GPa", nucleation-scale = "0.04 GPa", nucleation-rate = "3e15 m-3.s-1", '
                   'nucleation-size = "1 um", growth-stress = "0.1 GPa", viscosity = "2 Pa s"',
    "minimum-pressure": 'kind = "minimum-pressure", tension = "1.2 GPa"',
    "mean": 'kind = "tensile", threshold = "1.5 GPa", exponent = 2, time = "0.05 us", length = "0.6 mm"',
}
UP = {"planar": "y", "axisymmetric": "z", "3d": "z"}
EXTENT = {"planar": {"x": (-10, 10), "y": (-8, 10)}, "axisymmetric": {"r": (0, 10), "z": (-8, 10)},
          "3d": {"x": (-6, 6), "y": (0, 6), "z": (-5, 7)}}
CELL = {"planar": 0.25, "axisymmetric": 0.25, "3d": 0.5}  # mm


def damaged(rng, name, material):
    """A material with one of the damage models, or none."""
    kind = rng.choice((*DAMAGE, "tensile", "none"))
    if kind == "tensile" or "johnson-holmquist" in material:
        return material_table(name, material)
    text = material_table(name, material, breaks=False).rstrip("\n") + "\n"
    return text + (f"damage = {{ {DAMAGE[kind]} }}\n" if kind in DAMAGE else "") + "\n"


def solid(rng, name):
    return damaged(rng, name, rng.choice(METALS if rng.random() < 0.75 else BRITTLE))


def body(name, material, shape, **more):
    keys = "".join(f"{k.replace('_', '-')} = {v}\n" for k, v in more.items())
    return f'[body.{name}]\n{material}\nshape = {{ {shape} }}\n{keys}\n'


def of(name):
    return f'material = "{name}"'


def slab(geometry, low, high, wide=8):
    """A plate across the way of what falls on it, from `low` to `high`."""
    if geometry == "planar":
        return f'kind = "box", x = {pair(-wide, wide)}, y = {pair(low, high)}'
    if geometry == "axisymmetric":
        return f'kind = "cylinder", radius = {mm(wide)}, z = {pair(low, high)}'
    wide = min(wide, 5)
    return f'kind = "box", x = {pair(-wide, wide)}, y = {pair(-wide, wide)}, z = {pair(low, high)}'


def round_one(geometry, middle, radius):
    return ball("disc", radius, y=middle) if geometry == "planar" else ball("sphere", radius, z=middle)


def downwards(geometry, speed, across=0.0):
    ways = f'{UP[geometry]} = "{-speed:.4g} m/s"'
    if across and geometry != "axisymmetric":
        ways += f', x = "{across:.4g} m/s"'
    return f"{{ {ways} }}"


def driven_plate(rng, geometry):
    """A plate on a lit charge, with a gap or a second plate behind it."""
    thick = rng.choice((4, 6, 8)) * CELL[geometry]
    lit = f'{{ points = [{point(**{UP[geometry]: -4.9})}] }}'
    text = body("charge", of(f"explosive-products/{rng.choice(EXPLOSIVES)}"), slab(geometry, -5, 0, 6), detonation=lit)
    text += solid(rng, "first") + body("plate", of("first"), slab(geometry, 0, thick, 7))
    if rng.random() < 0.5:
        text += solid(rng, "second") + body("anvil", of("second"), slab(geometry, thick + rng.choice((0, 1)), thick + 3, 7))
    return text, 5


def shell_of_gas(rng, geometry):
    """Compressed gas in a shell that bursts."""
    inner = round_one(geometry, 1, 2.5)
    text = body("gas", of(f"gas/{rng.choice(GASES)}"), inner, pressure='"0.2 GPa"', temperature='"3000 K"')
    text += solid(rng, "first") + body("shell", of("first"), without(round_one(geometry, 1, rng.choice((3.2, 4))), inner))
    return text, 8


def plate_on_gas(rng, geometry):
    text = body("gas", of(f"gas/{rng.choice(GASES)}"), slab(geometry, -2, 0))
    text += solid(rng, "first") + body("flyer", of("first"), slab(geometry, 0, 2), velocity=downwards(geometry, rng.choice((300, 1000, 2000))))
    return text + solid(rng, "second") + body("block", of("second"), slab(geometry, -6, -2)), 4


def foam(rng, geometry):
    speed = rng.choice((200, 800, 2000))
    text = solid(rng, "first") + body("ball", of("first"), round_one(geometry, 2.6, 2.5), velocity=downwards(geometry, speed, 0.5 * speed))
    return text + body("foam", of("copper/pressed-powder"), slab(geometry, -6, 0)), 3000 / speed


def rigid_projectile(rng, geometry):
    speed = rng.choice((50, 300, 1000))
    up = UP[geometry]
    shape = rng.choice((round_one(geometry, 2.6, 2.5), f'kind = "cone", from = {point(**{up: 6})}, to = {point(**{up: 0.1})}, radius = "2 mm"',
                        f'kind = "ogive", from = {point(**{up: 7})}, to = {point(**{up: 0.1})}, radius = "1.5 mm", nose = "3 mm"'))
    mass = {"planar": '"0.2 kg/m"', "axisymmetric": '"1 g"', "3d": '"1 g"'}[geometry]
    text = body("ball", "rigid = true", shape, mass=mass, velocity=downwards(geometry, speed))
    return text + solid(rng, "first") + body("target", of("first"), slab(geometry, -4, 0)), min(10, 3000 / speed)


def piston(rng, geometry):
    up = UP[geometry]
    shape = f'kind = "half-space", point = {point(**{up: 2})}, normal = {{ {up} = -1 }}'
    history = f'[["0 us", {{ {up} = "0 m/s" }}], ["1 us", {{ {up} = "-500 m/s" }}], ["3 us", {{ {up} = "200 m/s" }}]]'
    text = body("piston", "rigid = true", shape, velocity_history=history)
    return text + solid(rng, "first") + body("block", of("first"), slab(geometry, -4, 2, 5)), 5


def hot_and_pressed(rng, geometry):
    first = rng.choice(METALS)
    text = damaged(rng, "first", first)
    text += body("striker", of("first"), slab(geometry, 0.1, 3, 5), velocity=downwards(geometry, 700), temperature=f'"{rng.choice((100, 600))} K"')
    return text + solid(rng, "second") + body("target", of("second"), slab(geometry, -4, 0), pressure=f'"{rng.choice((0.2, 2))} GPa"'), 4


def implosion(rng, geometry):
    """A ring or shell that closes upon itself, empty or about a core."""
    whole, hole = round_one(geometry, 1, 5), round_one(geometry, 1, rng.choice((3, 4)))
    centre = point(**{UP[geometry]: 1})
    text = solid(rng, "first") + body("shell", of("first"), without(whole, hole), radial_velocity=f'"{-rng.choice((100, 400, 1000))} m/s"',
                                      radial_centre=centre)
    if rng.random() < 0.5:
        text += solid(rng, "second") + body("core", of("second"), round_one(geometry, 1, 1.5))
    return text, 6


def stack(rng, geometry):
    """Thin plates, with and without gaps."""
    text, low = "", -5.0
    for n in range(3):
        thick = rng.choice((4, 5, 7)) * CELL[geometry]
        text += solid(rng, f"m{n}") + body(f"plate{n}", of(f"m{n}"), slab(geometry, low, low + thick))
        low += thick + rng.choice((0, 0, 0.1, 0.6))
    speed = rng.choice((20, 300, 1500))
    text += solid(rng, "first") + body("ball", of("first"), round_one(geometry, low + 1.6, 1.5), velocity=downwards(geometry, speed, 0.3 * speed))
    return text, min(8, 2500 / speed)


def heap(rng, geometry):
    """Balls beside and upon each other, struck by a plate."""
    places = [(x, y) for y in (-4, -1.4) for x in (-2.7, 0, 2.7)]
    text, speed = solid(rng, "first"), rng.choice((50, 400, 1200))
    for n, (x, y) in enumerate(places):
        if geometry == "axisymmetric" and x != 0:
            shape = f'kind = "torus", radius = "2.7 mm", tube = "1.3 mm", centre = {point(z=y)}'
            if x < 0:
                continue
        else:
            shape = ball("disc", 1.3, x=x, y=y) if geometry == "planar" else ball("sphere", 1.3, **({"x": x} if geometry == "3d" else {}), z=y)
        text += body(f"ball{n}", of("first"), shape)
    text += solid(rng, "second") + body("plate", of("second"), slab(geometry, 0, 2, 6), velocity=downwards(geometry, speed))
    return text, min(8, 2500 / speed)


KINDS = (driven_plate, shell_of_gas, plate_on_gas, foam, rigid_projectile, piston, hot_and_pressed, implosion, stack, heap)


def head(rng, title, geometry, end):
    text = f'format = 1\ntitle = "{title}"\n\n[domain]\ngeometry = "{geometry}"\n'
    text += "".join(f"{a} = {pair(*extent)}\n" for a, extent in EXTENT[geometry].items())
    if geometry == "3d":
        text += 'boundary = { y = ["symmetry", "outflow"] }\n'
    levels, block = rng.choice(((1, 0), (1, 0), (1, 9), (2, 0), (3, 10)))
    text += f"\n[mesh]\nfinest = {mm(CELL[geometry])}\noffset = {rng.choice((0, 0.37))}\nlevels = {levels}\nblock = {block}\n"
    text += f'\n[time]\nend = "{end:.3g} us"\n\n[method]\nstages = "{rng.choice(("three", "three", "one"))}"\n\n'
    law = rng.choice(("separable", "separable", "friction", "bonded"))
    text += f'[contact]\ndefault = "{law}"\n' + ("friction = 0.3\n" if law == "friction" else "")
    return text + f'\n[output]\nreport = false\nfields = {{ every = "{end:.3g} us" }}\n\n'


def varied_impact(number):
    """Name and text of case `number`."""
    rng = random.Random(1000 + number)
    kind = KINDS[number % len(KINDS)]
    geometry = rng.choice(("planar", "planar", "axisymmetric", "axisymmetric", "3d"))
    if kind is rigid_projectile and geometry == "3d":
        geometry = "axisymmetric"  # half of a free body would be pushed off its plane of symmetry
    bodies, end = kind(rng, geometry)
    return f"{kind.__name__}_{number:03}", head(rng, kind.__name__.replace("_", " "), geometry, end) + bodies
