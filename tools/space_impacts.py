"""Impacts in space for tools/sample_impacts: spheres, rods, bars, plates and rings that meet slabs, walls and each other, straight and
askew. Coarse (cells of 0.5 mm, 5 to 11 of them across a striker), half of each body by symmetry, so that each takes seconds. What
strikes a wall does not break.
"""

from random_impacts import ball, material_table, without

SPHERE = ball("sphere", 2.5, z=2.6)
SLAB = 'kind = "box", x = ["-7 mm", "7 mm"], y = ["-7 mm", "7 mm"], z = ["-5 mm", "0 mm"]'
THIN = 'kind = "box", x = ["-7 mm", "7 mm"], y = ["-7 mm", "7 mm"], z = ["-2.5 mm", "0 mm"]'
ROD = 'kind = "cylinder", from = { x = "-1 mm", z = "2.2 mm" }, to = { x = "-5 mm", z = "7 mm" }, radius = "1.5 mm"'
CROSSED = ('kind = "cylinder", from = { y = "-5 mm", z = "4.2 mm" }, to = { y = "5 mm", z = "4.2 mm" }, radius = "1.5 mm"',
           'kind = "cylinder", from = { x = "-5 mm", z = "1 mm" }, to = { x = "5 mm", z = "1 mm" }, radius = "1.5 mm"')
PIPE = without('kind = "cylinder", from = { y = "-5 mm", z = "3 mm" }, to = { y = "5 mm", z = "3 mm" }, radius = "2.8 mm"',
               'kind = "cylinder", from = { y = "-9 mm", z = "3 mm" }, to = { y = "9 mm", z = "3 mm" }, radius = "1.2 mm"')
CUBE = 'kind = "box", x = ["-2 mm", "2 mm"], y = ["-2 mm", "2 mm"], z = ["0.1 mm", "4.1 mm"]'
PLATE = 'kind = "box", x = ["-5 mm", "5 mm"], y = ["-4 mm", "4 mm"], z = ["0.1 mm", "2.6 mm"]'
BAR = 'kind = "cylinder", from = { z = "0 mm" }, to = { z = "12 mm" }, radius = "2.4 mm"'
AL, CU, STEEL = "aluminium/6061-t6", "copper/ofhc-johnson-cook", "steel/4340"
IMPACTS = {  # name: shapes of striker and target (none: a rigid wall), their materials, velocity [m/s], end [us], more keys of the striker
    "sphere_60": (SPHERE, SLAB, STEEL, AL, (850, 0, -500), 6, ""),
    "sphere_80": (SPHERE, SLAB, "steel/s-7", "aluminium/2024-t351", (985, 0, -174), 8, ""),
    "sphere_wall_400": (SPHERE, None, CU, None, (0, 0, -400), 8, ""),
    "sphere_wall_45": (SPHERE, None, AL, None, (300, 0, -300), 8, ""),
    "sphere_spin": (SPHERE, SLAB, STEEL, CU, (0, 0, -300), 8, 'spin = { y = "5e4 rad/s" }\nspin-centre = { z = "2.6 mm" }\n'),
    "sphere_2000": (SPHERE, SLAB, AL, AL, (0, 0, -2000), 3, ""),
    "sphere_4000_30": (SPHERE, THIN, AL, AL, (2000, 0, -3464), 2.5, ""),
    "shell_500": (without(SPHERE, ball("sphere", 1.3, z=2.6)), SLAB, "titanium/ti-6al-4v-johnson-cook", STEEL, (0, 0, -500), 6, ""),
    "sphere_sphere": (ball("sphere", 2.5, x=-2, z=7.4), SPHERE, CU, STEEL, (0, 0, -400), 6, ""),
    "rod_45": (ROD, SLAB, "tungsten-alloy/johnson-cook", STEEL, (700, 0, -700), 6, ""),
    "rod_through": (ROD, THIN, STEEL, AL, (500, 0, -800), 8, ""),
    "rods": (*CROSSED, STEEL, STEEL, (0, 0, -500), 6, ""),
    "cube_corner": (f'kind = "moved", shape = {{ {CUBE} }}, angle = "45 deg", axis = {{ y = 1 }}, shift = {{ z = "1.6 mm" }}', SLAB, STEEL, CU,
                    (0, 0, -400), 6, ""),
    "cube_flat": (CUBE, SLAB, "aluminium/7075-t6", AL, (300, 0, -600), 6, ""),
    "plate_10": (f'kind = "moved", shape = {{ {PLATE} }}, angle = "10 deg", axis = {{ y = 1 }}, shift = {{ z = "0.9 mm" }}', SLAB, CU, AL,
                 (0, 0, -500), 4, ""),
    "bar_wall": (BAR, None, "tantalum/steinberg", None, (0, 0, -200), 20, ""),
    "bar_wall_10": (f'kind = "moved", shape = {{ {BAR} }}, angle = "10 deg", axis = {{ y = 1 }}, shift = {{ z = "0.5 mm" }}', None, CU, None,
                    (-35, 0, -197), 20, ""),
    "cone_700": ('kind = "cone", from = { z = "6 mm" }, to = { z = "0.1 mm" }, radius = "2.5 mm"', SLAB, STEEL, AL, (0, 0, -700), 6, ""),
    "ring_400": ('kind = "torus", radius = "3.5 mm", tube = "1.5 mm", centre = { z = "1.6 mm" }', SLAB, CU, STEEL, (0, 0, -400), 6, ""),
    "pipe_500": (PIPE, SLAB, AL, STEEL, (0, 0, -500), 6, ""),
    "ogive_600": ('kind = "ogive", from = { z = "8 mm" }, to = { z = "0.1 mm" }, radius = "2 mm", nose = "4 mm"', THIN, "steel/maraging-250", AL,
                  (0, 0, -600), 10, ""),
    "ice_300": (SPHERE, SLAB, "ice/water", STEEL, (0, 0, -300), 6, ""),
    "rock_600": (SPHERE, SLAB, STEEL, "rock/granite", (200, 0, -600), 6, ""),
    "ceramic_800": (SPHERE, SLAB, STEEL, "alumina/99.5-johnson-holmquist", (0, 0, -800), 5, ""),
}


def impact(striker, target, first, second, velocity, end, keys):
    """Text of the case file of one impact."""
    text = 'format = 1\ntitle = "Impact in space"\n\n[domain]\ngeometry = "3d"\nx = ["-8 mm", "8 mm"]\ny = ["0 mm", "8 mm"]\n'
    text += f'z = ["{-10 if target else -1} mm", "13 mm"]\nboundary = {{ y = ["symmetry", "outflow"] }}\n\n[mesh]\nfinest = "0.5 mm"\n\n'
    text += f'[time]\nend = "{end} us"\n\n[output]\nreport = false\nfields = {{ every = "{end} us" }}\n\n'
    way = ", ".join(f'{a} = "{v} m/s"' for a, v in zip("xyz", velocity))
    text += material_table("first", first, breaks=bool(target))
    text += f'[body.striker]\nmaterial = "first"\nshape = {{ {striker} }}\nvelocity = {{ {way} }}\n{keys}\n'
    if not target:
        return text + '[body.wall]\nrigid = true\nshape = { kind = "half-space", point = { z = "0 mm" }, normal = { z = 1 } }\n'
    return text + material_table("second", second) + f'[body.target]\nmaterial = "second"\nshape = {{ {target} }}\n'
