#!/usr/bin/env python3
"""Writes the meshes of the physical scenes.

Needs the gmsh module (pip install gmsh) and the libraries it loads (Debian: libglu1-mesa libxrender1
libxcursor1 libxft2 libxinerama1). With the same version of gmsh, running it again writes the same bytes.

    python3 meshes/scenes/generate.py

Every scene's geometry is one function below; lengths are in metres. The formats differ on purpose, so
that the standard scenes exercise all four that Gmsh writes.
"""

from pathlib import Path

import antiicing
import gmsh

HERE = Path(__file__).resolve().parent
geo = gmsh.model.geo


def begin(name):
    gmsh.model.add(name)


def polygon(points):
    """Corner points as (x, y, mesh size); returns (points, lines)."""
    corners = [geo.addPoint(x, y, 0, size) for x, y, size in points]
    lines = [geo.addLine(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
    return corners, lines


def group(dimension, name, tags):
    gmsh.model.setPhysicalName(dimension, gmsh.model.addPhysicalGroup(dimension, tags), name)


def write(name, version, binary, folder=HERE):
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", int(binary))
    gmsh.write(str(folder / f"{name}.msh"))
    kinds, tags, _ = gmsh.model.mesh.getElements()
    counts = dict(zip(kinds, map(len, tags)))
    print(f"{name}: {counts.get(2, 0)} triangles, {counts.get(3, 0)} quads, MSH {version}",
          "binary" if binary else "ASCII")


def levee_domain(h):
    """A levee 6 m high with slopes of 1:2 on both sides, sand on a clay foot, river at 4.5 m.

    Returns its curves by name, a name of the scene or a part of one."""
    # The clay lies below y = 1.5 m; points run counterclockwise from the river-side toe.
    toe_r, toe_l = geo.addPoint(0, 0, 0, h), geo.addPoint(30, 0, 0, h / 2)
    land15, land = geo.addPoint(27, 1.5, 0, h / 2), geo.addPoint(18, 6, 0, h)
    crest, river45 = geo.addPoint(12, 6, 0, h), geo.addPoint(9, 4.5, 0, h)
    river15 = geo.addPoint(3, 1.5, 0, h)
    line = lambda a, b: geo.addLine(a, b)
    base = line(toe_r, toe_l)
    drain, face = line(toe_l, land15), line(land15, land)
    top, dry = line(land, crest), line(crest, river45)
    wet, foot, layer = line(river45, river15), line(river15, toe_r), line(river15, land15)
    clay = geo.addPlaneSurface([geo.addCurveLoop([base, drain, -layer, foot])])
    sand = geo.addPlaneSurface([geo.addCurveLoop([layer, face, top, dry, wet])])
    geo.synchronize()
    group(1, "river", [wet, foot])
    group(1, "base", [base])
    group(1, "seepage face", [drain, face])
    group(1, "crest", [top])
    group(1, "bank", [dry])
    group(2, "clay", [clay])
    group(2, "sand", [sand])
    return {"drain": drain, "face": face, "crest": top}


def levee():
    """The levee on a mesh that a microcontroller can hold."""
    begin("levee")
    levee_domain(0.55)
    gmsh.model.mesh.generate(2)
    write("levee", 4.1, False)


def levee_fine():
    """The levee for the firmware's tests: few contact edges, the inside far finer than they are."""
    begin("levee-fine")
    curves = levee_domain(1)
    # Edges of 0.21 m on the seepage face, 64 in all, and of 0.19 m on the crest.
    for curve, edges in (("drain", 16), ("face", 48), ("crest", 32)):
        gmsh.model.mesh.setTransfiniteCurve(curves[curve], edges + 1)
    field = gmsh.model.mesh.field
    distance, size = field.add("Distance"), field.add("Threshold")
    field.setNumbers(distance, "CurvesList", list(curves.values()))
    field.setNumber(distance, "Sampling", 400)
    for option, value in (("InField", distance), ("SizeMin", 0.2), ("DistMin", 0),
                          ("SizeMax", 0.082), ("DistMax", 0.8)):
        field.setNumber(size, option, value)
    field.setAsBackgroundMesh(size)
    # The field alone tells the size.
    options = ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints")
    for option in options:
        gmsh.option.setNumber(f"Mesh.{option}", 0)
    gmsh.model.mesh.generate(2)
    for option in options:
        gmsh.option.setNumber(f"Mesh.{option}", 1)
    write("levee-fine", 4.1, True, HERE.parents[1] / "tests" / "firmware" / "scenes")


def dam():
    """A zoned dam 10 m high on 8 m of gravel, reservoir at 8.5 m: shells, core, toe drain, a cut-off wall below the core."""
    begin("dam")
    far, near, fine = 4, 1.2, 0.6
    at = lambda x, y, size: geo.addPoint(x, y, 0, size)
    heel, toe, drain = at(0, 0, near), at(50, 0, near), at(43, 0, near)
    core_left, wall_left, wall_right, core_right = (at(x, 0, fine) for x in (20, 24, 25, 29))
    slope_wet, crest_left, crest_right, slope_drain = at(17.85, 8.5, near), at(21, 10, near), at(27, 10, near), at(45.4, 2, near)
    core_top = [at(25.25, 9, fine), at(23.25, 9, fine)]
    wall_foot = [at(24, -5, fine), at(25, -5, fine)]
    left, left_base, right_base, right = at(-30, 0, far), at(-30, -8, far), at(80, -8, far), at(80, 0, far)
    line = geo.addLine
    floor = [line(left, heel), line(heel, core_left), line(core_left, wall_left), line(wall_left, wall_right),
             line(wall_right, core_right), line(core_right, drain), line(drain, toe), line(toe, right)]
    wall = [line(wall_left, wall_foot[0]), line(*wall_foot), line(wall_foot[1], wall_right)]
    around = [line(right, right_base), line(right_base, left_base), line(left_base, left)]
    slopes = [line(toe, slope_drain), line(slope_drain, crest_right), line(crest_right, crest_left),
              line(crest_left, slope_wet), line(slope_wet, heel)]
    core = [line(core_right, core_top[0]), line(*core_top), line(core_top[1], core_left)]
    inner = line(drain, slope_drain)
    surface = lambda *loop: geo.addPlaneSurface([geo.addCurveLoop(loop)])
    back = lambda lines: [-one for one in reversed(lines)]
    surfaces = {
        "foundation": surface(*floor[:3], *wall, *floor[4:], *around),
        "wall": surface(floor[3], *back(wall)),
        "core": surface(*floor[2:5], *core),
        "shell": surface(floor[1], *back(core), floor[5], inner, *slopes[1:]),
        "toe drain": surface(floor[6], slopes[0], -inner),
    }
    geo.synchronize()
    group(1, "reservoir", [floor[0], slopes[4]])
    group(1, "tail water", [floor[7]])
    group(1, "seepage face", slopes[:2])
    group(1, "crest", [slopes[2]])
    group(1, "bank", [slopes[3]])
    group(1, "base", [around[1]])
    group(1, "sides", [around[0], around[2]])
    for name, tag in surfaces.items():
        group(2, name, [tag])
    gmsh.model.mesh.generate(2)
    write("dam", 4.1, False, HERE.parents[1] / "tests" / "firmware" / "scenes")


def slab():
    """A wing skin 300 mm long and 12 mm thick with a 40 mm rib; heaters on the inner face."""
    begin("slab")
    size = 0.0035
    _, lines = polygon([(0, 0, size), (0.13, 0, size), (0.13, -0.04, size), (0.15, -0.04, size),
                        (0.15, 0, size), (0.3, 0, size), (0.3, 0.012, size), (0, 0.012, size)])
    skin_foot = geo.addLine(2, 5)
    skin = geo.addPlaneSurface([geo.addCurveLoop([lines[0], skin_foot, *lines[4:]])])
    rib = geo.addPlaneSurface([geo.addCurveLoop([*lines[1:4], -skin_foot])])
    geo.synchronize()
    group(1, "heater", [lines[0], lines[4]])
    group(1, "rib sides", [lines[1], lines[3]])
    group(1, "rib foot", [lines[2]])
    group(1, "ends", [lines[5], lines[7]])
    group(1, "air", [lines[6]])
    group(2, "laminate", [skin])
    group(2, "aluminium", [rib])
    gmsh.option.setNumber("Mesh.Algorithm", 8)
    gmsh.option.setNumber("Mesh.RecombineAll", 1)
    gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 2)
    gmsh.model.mesh.generate(2)
    gmsh.option.setNumber("Mesh.RecombineAll", 0)
    gmsh.option.setNumber("Mesh.Algorithm", 6)
    write("slab", 2.2, False)


def strip():
    """An elastomer strip 40 mm long and 6 mm thick: quads under the indenter, triangles below."""
    begin("strip")
    columns, rows, half, depth, band = 64, 4, 0.02, 0.006, 0.0015
    corners = [(-half, -depth), (half, -depth), (half, -band), (half, 0), (-half, 0), (-half, -band)]
    a, b, c, d, e, f = (geo.addPoint(x, y, 0, 0.0011) for x, y in corners)
    bottom, right_low, right_up = geo.addLine(a, b), geo.addLine(b, c), geo.addLine(c, d)
    top, left_up, left_low = geo.addLine(d, e), geo.addLine(e, f), geo.addLine(f, a)
    middle = geo.addLine(f, c)
    below = geo.addPlaneSurface([geo.addCurveLoop([bottom, right_low, -middle, left_low])])
    above = geo.addPlaneSurface([geo.addCurveLoop([middle, right_up, top, left_up])])
    for long in (middle, top):
        geo.mesh.setTransfiniteCurve(long, columns + 1)
    for short in (right_up, left_up):
        geo.mesh.setTransfiniteCurve(short, rows + 1)
    geo.mesh.setTransfiniteSurface(above)
    geo.mesh.setRecombine(2, above)
    geo.synchronize()
    group(1, "support", [bottom])
    group(1, "sides", [right_low, right_up, left_up, left_low])
    group(1, "skin", [top])
    group(2, "elastomer", [below, above])
    gmsh.model.mesh.generate(2)
    write("strip", 4.1, True)


def pit():
    """Electrolyte above a steel plate with a corrosion pit: two re-entrant corners."""
    begin("pit")
    far, near = 0.006, 0.0009
    _, lines = polygon([(-0.05, 0, far), (-0.008, 0, near), (-0.008, -0.012, near / 0.6),
                        (0.008, -0.012, near / 0.6), (0.008, 0, near), (0.05, 0, far),
                        (0.05, 0.04, far), (-0.05, 0.04, far)])
    water = geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()
    group(1, "steel", lines[0:5])
    group(1, "insulated", [lines[5], lines[7]])
    group(1, "anode", [lines[6]])
    group(2, "electrolyte", [water])
    gmsh.model.mesh.generate(2)
    write("pit", 2.2, True)


def block(name, width, height, columns, rows, version, quads):
    """A structured rectangle with its sides named."""
    begin(name)
    _, (bottom, right, top, left) = polygon([(0, 0, 1), (width, 0, 1), (width, height, 1),
                                            (0, height, 1)])
    surface = geo.addPlaneSurface([geo.addCurveLoop([bottom, right, top, left])])
    for curve, cells in ((bottom, columns), (top, columns), (right, rows), (left, rows)):
        geo.mesh.setTransfiniteCurve(curve, cells + 1)
    geo.mesh.setTransfiniteSurface(surface, "Right")
    if quads:
        geo.mesh.setRecombine(2, surface)
    geo.synchronize()
    for side, curve in (("bottom", bottom), ("right", right), ("top", top), ("left", left)):
        group(1, side, [curve])
    group(2, "domain", [surface])
    gmsh.model.mesh.generate(2)
    write(name, version, False)


def main():
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 2)
    gmsh.option.setNumber("General.NumThreads", 1)
    levee()
    levee_fine()
    dam()
    slab()
    strip()
    pit()
    block("membrane", 0.2, 0.05, 48, 12, 4.1, quads=True)
    block("square", 1, 1, 32, 32, 2.2, quads=False)
    gmsh.finalize()
    antiicing.main()


main()
