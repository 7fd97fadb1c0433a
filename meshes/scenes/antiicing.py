#!/usr/bin/env python3
"""Writes the mesh of the anti-icing slab as it is built: a skin with three heater mats and two webs.

Needs Python 3.8 or later and nothing else. Running it again writes the same bytes; generate.py does so too.

    python3 meshes/scenes/antiicing.py

The skin is 160 mm long: 2 mm of laminate, and outside of it 1 mm of titanium. The mats lie on its inner face, y = 0. Between
them stand the webs, 8 mm wide and 20 mm deep, beside which 2.5 mm of the face are bare. Columns are narrow beside the webs,
where the heat changes most. Rectangles, in which A is constant, are halved: no angle of a triangle is obtuse, not even where
lengths are measured by A, so that no entry of the matrix off its diagonal is positive and a worst case can be proved.
"""

from pathlib import Path

HERE = Path(__file__).resolve().parent
# Widths of the columns in millimetres: of a mat from its far end to a web, of the bare skin and the web between two mats.
END = (6, 6, 5, 5, 4, 4, 3, 3, 2, 2)
ROOT = (1.5, 1, 1.5, 2.5, 2.5, 1.5, 1, 1.5)
BETWEEN = (2, 3, 4, 5, 6, 6, 5, 4, 3, 2)
AFT = (2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7)
# Lines of the skin and of the webs in metres, from below.
SKIN = (0.0, 0.001, 0.002, 0.003)
WEB = (-0.02, -0.01, -0.004, 0.0)
# Columns of each mat and each web, and those without a mat.
WIDTHS = END + ROOT + BETWEEN + ROOT + AFT
COLUMNS = len(WIDTHS)
MATS = {"nose": range(0, 10), "middle": range(18, 28), "aft": range(36, 48)}
WEBS = (range(12, 16), range(30, 34))
BARE = (10, 11, 16, 17, 28, 29, 34, 35)
CURVES = ("nose", "middle", "aft", "outside", "bare", "web feet", "web sides", "ends")
SURFACES = ("laminate", "titanium", "aluminium")


def build():
    """Vertices, and elements as (Gmsh type, physical tag, vertices)."""
    numbers, vertices = {}, []

    def at(column, y):
        key = (column, y)
        if key not in numbers:
            vertices.append((round(sum(WIDTHS[:column]) / 1000, 9), y))
            numbers[key] = len(vertices)
        return numbers[key]

    def cell(column, low, high, surface):
        corners = at(column, low), at(column + 1, low), at(column + 1, high), at(column, high)
        for half in (corners[:3], (corners[0], *corners[2:])):
            cells.append((2, SURFACES.index(surface) + 1, half))

    def side(curve, first, last):
        lines.append((1, CURVES.index(curve) + 1, (at(*first), at(*last))))

    cells, lines = [], []
    for low, high in zip(SKIN, SKIN[1:]):
        for column in range(COLUMNS):
            cell(column, low, high, "laminate" if high <= SKIN[-2] else "titanium")
        for column in (0, COLUMNS):
            side("ends", (column, low), (column, high))
    for web in WEBS:
        for low, high in zip(WEB, WEB[1:]):
            for column in web:
                cell(column, low, high, "aluminium")
            for column in (web.start, web.stop):
                side("web sides", (column, low), (column, high))
        for column in web:
            side("web feet", (column, WEB[0]), (column + 1, WEB[0]))
    for name, mat in MATS.items():
        for column in mat:
            side(name, (column, SKIN[0]), (column + 1, SKIN[0]))
    for column in BARE:
        side("bare", (column, SKIN[0]), (column + 1, SKIN[0]))
    for column in range(COLUMNS):
        side("outside", (column, SKIN[-1]), (column + 1, SKIN[-1]))
    return vertices, lines + cells


def msh22(vertices, elements):
    """Gmsh MSH 2.2 ASCII."""
    names = [f'1 {tag} "{name}"' for tag, name in enumerate(CURVES, 1)]
    names += [f'2 {tag} "{name}"' for tag, name in enumerate(SURFACES, 1)]
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    text += ["$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames"]
    text += ["$Nodes", str(len(vertices))]
    text += [f"{k} {x!r} {y!r} 0" for k, (x, y) in enumerate(vertices, 1)]
    text += ["$EndNodes", "$Elements", str(len(elements))]
    for k, (kind, tag, corners) in enumerate(elements, 1):
        text.append(f"{k} {kind} 2 {tag} {tag} " + " ".join(map(str, corners)))
    return "\n".join(text + ["$EndElements", ""])


def main():
    vertices, elements = build()
    (HERE / "antiicing.msh").write_text(msh22(vertices, elements), encoding="utf-8")
    triangles = sum(kind == 2 for kind, _, _ in elements)
    print(f"antiicing: {triangles} triangles, 0 quads, MSH 2.2 ASCII")


if __name__ == "__main__":
    main()
