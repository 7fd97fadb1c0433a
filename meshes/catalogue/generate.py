#!/usr/bin/env python3
"""Writes the catalogue: scenes with exact solutions, and the structured meshes they stand on.

Needs Python 3.8 or later and nothing else. Running it again writes the same bytes.

    python3 meshes/catalogue/generate.py

Domain (-1, 1) x (0, 1) in 2n x n squares, contact on y = 0, Dirichlet on the other three sides.
The same domain with other n carries the condensed problems of `cargo xtask peers`.
Squares are cut from the lower left to the upper right corner (tri), kept (quad), or alternate like
the fields of a chessboard (mixed).
"""

from math import exp, pi
from pathlib import Path

HERE = Path(__file__).resolve().parent
LIMITS = HERE.parent / "limits"
TIME = HERE.parent / "time"
PEERS = HERE.parents[1] / "tests/firmware/peers"


# --- meshes -----------------------------------------------------------------------------------


def grid(n, kind):
    """Vertices, and elements as (Gmsh type, physical tag, vertices)."""
    columns = 2 * n
    number = lambda i, j: j * (columns + 1) + i + 1
    vertices = [(i / n - 1, j / n) for j in range(n + 1) for i in range(columns + 1)]
    lines = [(1, 1, (number(i, 0), number(i + 1, 0))) for i in range(columns)]
    lines += [(1, 2, (number(i, n), number(i + 1, n))) for i in range(columns)]
    for i in (0, columns):
        lines += [(1, 2, (number(i, j), number(i, j + 1))) for j in range(n)]
    cells = []
    for j in range(n):
        for i in range(columns):
            a, b = number(i, j), number(i + 1, j)
            c, d = number(i + 1, j + 1), number(i, j + 1)
            region = 1 if i < n else 2
            if kind == "quad" or (kind == "mixed" and (i + j) % 2 == 0):
                cells.append((3, region, (a, b, c, d)))
            else:
                cells += [(2, region, (a, b, c)), (2, region, (a, c, d))]
    return vertices, lines + cells


def column(n):
    """(0, 4/n) x (0, 1) in 4 x n squares, each cut in two; the sides are a group of their own."""
    number = lambda i, j: 5 * j + i + 1
    vertices = [(i / n, j / n) for j in range(n + 1) for i in range(5)]
    lines = [(1, 1, (number(i, 0), number(i + 1, 0))) for i in range(4)]
    lines += [(1, 2, (number(i, n), number(i + 1, n))) for i in range(4)]
    lines += [(1, 3, (number(i, j), number(i, j + 1))) for i in (0, 4) for j in range(n)]
    cells = []
    for j in range(n):
        for i in range(4):
            a, b = number(i, j), number(i + 1, j)
            c, d = number(i + 1, j + 1), number(i, j + 1)
            cells += [(2, 1, (a, b, c)), (2, 1, (a, c, d))]
    return vertices, lines + cells


NAMES = ['1 1 "contact"', '1 2 "dirichlet"', '2 1 "left"', '2 2 "right"']
OF_COLUMN = ['1 1 "contact"', '1 2 "dirichlet"', '1 3 "sides"', '2 1 "left"']


def msh22(vertices, elements, names=NAMES):
    """Gmsh MSH 2.2 ASCII."""
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    text += ["$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames"]
    text += ["$Nodes", str(len(vertices))]
    text += [f"{k} {x!r} {y!r} 0" for k, (x, y) in enumerate(vertices, 1)]
    text += ["$EndNodes", "$Elements", str(len(elements))]
    for k, (kind, tag, corners) in enumerate(elements, 1):
        text.append(f"{k} {kind} 2 {tag} {tag} " + " ".join(map(str, corners)))
    return "\n".join(text + ["$EndElements", ""])


# --- exact solutions, as expressions of the scene file ------------------------------------------


def case_a(x, y):
    p, m = f"max({x},0)", f"max(-({x}),0)"
    return {
        "u": f"{p}^3 - ({y})*{m}^3",
        "gradient": (f"3*{p}^2 + 3*({y})*{m}^2", f"-({m}^3)"),
        "f": f"-6*{p} + 6*({y})*{m}",
    }


def case_b(x, y):
    r, theta = f"sqrt(({x})^2 + ({y})^2)", f"atan2({y},{x})"
    return {
        "u": f"{r}^1.5*cos(1.5*{theta})",
        "gradient": (f"1.5*sqrt({r})*cos(0.5*{theta})", f"-1.5*sqrt({r})*sin(0.5*{theta})"),
        "f": "0",
    }


def case_h(x, y, a="0.55"):
    """Re[z s - a^2 log((z + s)/a)] with s = sqrt(z - a) sqrt(z + a); its derivative is 2 s."""
    size = f"((({x})-{a})^2+({y})^2)^0.25*((({x})+{a})^2+({y})^2)^0.25"
    angle = f"(0.5*atan2({y},({x})-{a}) + 0.5*atan2({y},({x})+{a}))"
    re, im = f"{size}*cos{angle}", f"{size}*sin{angle}"
    log = f"0.5*ln(((({x})+{re})^2 + (({y})+{im})^2)/{a}^2)"
    return {
        "u": f"({x})*{re} - ({y})*{im} - {a}^2*{log}",
        "gradient": (f"2*{re}", f"-2*{im}"),
        "f": "0",
    }


def case_l(x, y, a="0.55", least="0", most="1.5"):
    """A flux between two ends: in contact for |x| < a, at its least beyond a, at its most beyond -a.

    With s as in case H, z = a sin(xi + i eta), beta = (least - most)/pi and c = (least + most)/2,
    u = -Im[c z + beta (z (xi + i eta) + s/i)]; its gradient is (-beta eta, -(c + beta xi)).
    """
    size = f"((({x})-{a})^2+({y})^2)^0.25*((({x})+{a})^2+({y})^2)^0.25"
    angle = f"(0.5*atan2({y},({x})-{a}) + 0.5*atan2({y},({x})+{a}))"
    re, im = f"{size}*cos{angle}", f"{size}*sin{angle}"
    xi = f"(pi/2 - atan2(({y})+{im}, ({x})+{re}))"
    eta = f"(0.5*ln(((({x})+{re})^2 + (({y})+{im})^2)/{a}^2))"
    beta, c = f"({least}-{most})/pi", f"({least}+{most})/2"
    return {
        "u": f"-({c}*({y}) + {beta}*(({x})*{eta} + ({y})*{xi} - {re}))",
        "gradient": (f"-{beta}*{eta}", f"-({c} + {beta}*{xi})"),
        "f": "0",
        "range": (least, most),
    }


def plus(case, g, gradient, minus_laplacian):
    """U + G with the gap G: any G with dG/dy = 0 on y = 0."""
    gx, gy = case["gradient"]
    return {
        "u": f"{case['u']} + ({g})",
        "gradient": (f"{gx} + ({gradient[0]})", f"{gy} + ({gradient[1]})"),
        "f": f"{case['f']} + ({minus_laplacian})",
        "gap": g,
    }


def sheared(case, s, kappa):
    """u(x, y) = U(x - s y, kappa y) solves the problem with A = [[k + s^2/k, s/k], [s/k, 1/k]]."""
    u = case(f"x - {s}*y", f"{kappa}*y")
    ux, uy = u["gradient"]
    return {
        "u": u["u"],
        "gradient": (ux, f"-{s}*({ux}) + {kappa}*({uy})"),
        "f": f"{kappa}*({u['f']})",
        "conductivity": [repr(kappa + s * s / kappa), repr(s / kappa), repr(1 / kappa)],
    }


def jump(k):
    """r^alpha cos(alpha theta) for x > 0 and -k^(-1/2) r^alpha sin(alpha(pi - theta)) for x < 0.

    (1 + sign(x))/2 chooses between the halves. The gradients are alpha r^(alpha-1) times
    (cos, -sin)((alpha-1) theta) and (-sin, cos)((alpha-1)(pi - theta)).
    """
    alpha = f"(2 - 2/pi*atan(sqrt({k})))"
    r, theta = "sqrt(x^2 + y^2)", "atan2(y,x)"
    right, left = "(0.5 + 0.5*sign(x))", "(0.5 - 0.5*sign(x))"
    size = f"{r}^{alpha}"
    slope = f"{alpha}*{r}^({alpha} - 1)"
    down = f"{alpha}*(pi - {theta})"
    scale = f"({k})^-0.5"
    u = f"{size}*({right}*cos({alpha}*{theta}) - {left}*{scale}*sin({down}))"
    less, mirrored = f"({alpha} - 1)*{theta}", f"({alpha} - 1)*(pi - {theta})"
    ux = f"{slope}*({right}*cos({less}) + {left}*{scale}*sin({mirrored}))"
    uy = f"{slope}*(-{right}*sin({less}) - {left}*{scale}*cos({mirrored}))"
    return {"u": u, "gradient": (ux, uy), "f": "0", "materials": {"left": k, "right": "1"}}


# --- solutions of steps in time, c = A = 1 ------------------------------------------------------


RELEASE = 0.138785297043


def release():
    """0 < y < 1, held at 1 above; u = -y at first, in contact until t* and then free."""
    waves = lambda terms, of: "(" + "+".join(
        f"{c:.12g}*exp(-({m}*pi)^2*t)*{of}({m}*pi*y)" for c, m in terms) + ")"
    touching = [(4 * (-1) ** m / (m * pi), m) for m in range(1, 31)]
    free = []
    for j in range(1, 11):
        nu = (j - 0.5) * pi
        a = -2 / nu**2
        for c, m in touching[:6]:
            a += 2 * c * exp(-((m * pi) ** 2) * RELEASE) * m * pi / ((m * pi) ** 2 - nu**2)
        free.append((a * exp(nu**2 * RELEASE), j - 0.5))
    slope = lambda terms, sign: [(sign * c * m * pi, m) for c, m in terms]
    before, after = f"(0.5+0.5*sign({RELEASE}-t))", f"(0.5-0.5*sign({RELEASE}-t))"
    return {
        "u": f"{before}*(y+{waves(touching, 'sin')}) + {after}*(1+{waves(free, 'cos')})",
        "gradient": ("0", f"{before}*(1+{waves(slope(touching, 1), 'cos')}) "
                          f"+ {after}*{waves(slope(free, -1), 'sin')}"),
        "f": "0",
        "value": "1",
        "time": (0.01, 0.4, "-y"),
    }


def breathing():
    """All of the contact boundary changes sides at t = 1/2."""
    s, opened = "sin(2*pi*t)", "(1 + sign(sin(2*pi*t)))/2"
    above, below = "(1-y)^2*(1+2*y)", "y*(1-y)^2"
    return {
        "u": f"max({s},0)*{above} + min({s},0)*{below}",
        "gradient": ("0", f"max({s},0)*(-6*y*(1-y)) + min({s},0)*((1-y)*(1-3*y))"),
        "f": f"2*pi*cos(2*pi*t)*({opened}*{above} + (1 - {opened})*{below}) "
             f"- max({s},0)*(12*y - 6) - min({s},0)*(6*y - 4)",
        "time": (0.02, 1, "0"),
    }


def travelling(t="t"):
    """The front of contact travels to the right with speed 1, without a source."""
    xi = f"(x + 0.3 - {t})"
    root, half = f"({xi}^2 + y^2)^0.25", f"(0.5*atan2(y, {xi}))"
    sigma, tau = f"({root}*cos{half})", f"({root}*sin{half})"
    bell = f"2/sqrt(pi)*exp(-{sigma}^2)"
    f = f"((1 + 2*{sigma}^2)*erf({sigma}) + {sigma}*{bell})"
    # Parabolic coordinates: xi + iy = (sigma + i tau)^2.
    by_sigma = f"((4*{sigma}*erf({sigma}) + 2*{bell})*(1 - 2*{tau}^2) - 2*{bell})"
    by_tau = f"(-4*{tau}*{f})"
    u = f"{f}*(1 - 2*{tau}^2) - 2*erf({sigma})"
    gradient = (f"({by_sigma}*{sigma} - {by_tau}*{tau})/(2*({xi}^2 + y^2)^0.5)",
                f"({by_sigma}*{tau} + {by_tau}*{sigma})/(2*({xi}^2 + y^2)^0.5)")
    initial = travelling("0")["u"] if t == "t" else ""
    return {"u": u, "gradient": gradient, "f": "0", "time": (0.03, 0.6, initial)}


def oscillating(t="t"):
    """The end of contact oscillates along the boundary."""
    x = f"(x - 0.3*sin(2*pi*{t}))"
    r2, theta = f"({x}^2 + y^2)", f"atan2(y, {x})"
    initial = oscillating("0")["u"] if t == "t" else ""
    return {
        "u": f"-({r2}^0.75*sin(1.5*{theta}))",
        "gradient": (f"-1.5*{r2}^0.25*sin(0.5*{theta})", f"-1.5*{r2}^0.25*cos(0.5*{theta})"),
        "f": f"0.9*pi*cos(2*pi*t)*{r2}^0.25*sin(0.5*{theta})",
        "time": (0.0125, 1, initial),
    }


# --- scenes -------------------------------------------------------------------------------------


def scene(title, mesh, case):
    text = [f'title = "{title}"', f'mesh = "{mesh}"', ""]
    materials = case.get("materials", {"default": case.get("conductivity", "1")})
    for name, value in materials.items():
        entries = ", ".join(f'"{entry}"' for entry in value) if isinstance(value, list) else None
        shown = f"[{entries}]" if entries else f'"{value}"'
        text += [f"[material.{name}]", f"conductivity = {shown}"]
        text += ["capacity = 1", ""] if len(case.get("time", ())) == 3 else [""]
    text += ["[source]", f'f = "{case["f"]}"', ""]
    text += ["[boundary.dirichlet]", 'kind = "dirichlet"', f'value = "{case.get("value", case["u"])}"', ""]
    text += ["[boundary.contact]", 'kind = "contact"', f'gap = "{case.get("gap", "0")}"']
    if "sides" in case:
        text += ["", "[boundary.sides]", 'kind = "neumann"', "flux = 0"]
    if "range" in case:
        least, most = case["range"]
        text += [f'flux = "{least}"', f'limit = "{most}"']
    text += [""]
    if "time" in case:
        step, end, *initial = case["time"]
        text += ["[time]", f"step = {step}", f"end = {end}"]
        text += [f'initial = "{of}"' for of in initial] + [""]
    gx, gy = case["gradient"]
    text += ["[exact]", f'u = "{case["u"]}"', f'gradient = ["{gx}", "{gy}"]', ""]
    return "\n".join(text)


def peer(n, mesh):
    """2n contact edges, half of them active in three strips, and loads that move the six ends.

    Eight waves along the contact line, the shorter the smaller; each has an input of its own.
    """
    text = [f'title = "Condensed: {2 * n} contact edges, eight inputs"', f'mesh = "{mesh}"', ""]
    text += ["[material.default]", 'conductivity = "1"', ""]
    text += ["[boundary.dirichlet]", 'kind = "dirichlet"', 'value = "0"', ""]
    text += ["[boundary.contact]", 'kind = "contact"', 'flux = "cos(3*pi*x) - 0.35"', ""]
    for k in range(1, 9):
        wave = f"{0.25 / k:.6f}*{'cos' if k % 2 else 'sin'}({k}*pi*x/2)"
        text += [f"[input.wave{k}]", 'of = "contact"', 'field = "flux"', f'pattern = "{wave}"']
        text += ["default = 0.0", ""]
    return "\n".join(text[:-1]) + "\n"


def main():
    for n in (8, 32):
        (PEERS / f"square-tri-{n}.msh").write_text(msh22(*grid(n, "tri")))
    for n in (8, 16, 32):
        mesh = f"square-tri-{n}.msh" if n != 16 else "../../../meshes/catalogue/square-tri-16.msh"
        (PEERS / f"contact-{2 * n}.toml").write_text(peer(n, mesh))
    for kind in ("tri", "quad", "mixed"):
        (HERE / f"square-{kind}-16.msh").write_text(msh22(*grid(16, kind)))
    a, b, h = case_a("x", "y"), case_b("x", "y"), case_h("x", "y")
    # The free points move by up to 0.03 from tick to tick.
    moving = {**case_h("x", "y", "(0.55 + 0.1*sin(2*pi*t))"), "time": (0.05, 1)}
    hg = plus(h, "-x^2 + y^2", ("-2*x", "2*y"), "0")
    hg["gap"] = "-x^2"
    ag = plus(a, "0.1*cos(pi*x)*(1 + y^2)",
              ("-0.1*pi*sin(pi*x)*(1 + y^2)", "0.2*cos(pi*x)*y"),
              "0.1*pi^2*cos(pi*x)*(1 + y^2) - 0.2*cos(pi*x)")
    ag["gap"] = "0.1*cos(pi*x)"
    patch = {"u": "1 + 0.5*x - 2*y", "gradient": ("0.5", "-2"), "f": "0", "gap": "1 + 0.5*x"}
    scenes = [
        ("a-tri", "A: smooth, with a source", "tri", a),
        ("a-quad", "A: smooth, with a source", "quad", a),
        ("b-tri", "B: the generic free boundary", "tri", b),
        ("b-quad", "B: the generic free boundary", "quad", b),
        ("h-tri", "H(0.55): punch, two free points", "tri", h),
        ("h-quad", "H(0.55): punch, two free points", "quad", h),
        ("h-mixed", "H(0.55): punch, triangles and quads", "mixed", h),
        ("moving-tri", "H(a(t)): punch, two free points that move", "tri", moving),
        ("hg-tri", "H_g(0.55): concave gap", "tri", hg),
        ("hg-quad", "H_g(0.55): concave gap", "quad", hg),
        ("ag-mixed", "A + G: arbitrary gap and source", "mixed", ag),
        ("j100-tri", "J(100): conductivity 100 beside 1", "tri", jump("100")),
        ("j001-tri", "J(0.01): conductivity 0.01 beside 1", "tri", jump("0.01")),
        ("t-a-tri", "T(0.5, 1) of A: oblique tensor", "tri", sheared(case_a, 0.5, 1)),
        ("t-h-tri", "T(3, 1) of H: condition 119", "tri", sheared(case_h, 3, 1)),
        ("patch-mixed", "linear u, all in contact: exact to rounding", "mixed", patch),
    ]
    for name, title, kind, case in scenes:
        (HERE / f"{name}.toml").write_text(scene(title, f"square-{kind}-16.msh", case))
    moved = [
        ("breathing-tri", "E2: contact that opens and closes everywhere at once", breathing()),
        ("travelling-tri", "E3: a front of contact that travels", travelling()),
        ("oscillating-tri", "E4: an end of contact that oscillates", oscillating()),
    ]
    for name, title, case in moved:
        mesh = "../catalogue/square-tri-16.msh"
        (TIME / f"{name}.toml").write_text(scene(title, mesh, case))
    (TIME / "column-tri-16.msh").write_text(msh22(*column(16), OF_COLUMN))
    case = {**release(), "sides": True}
    (TIME / "release-tri.toml").write_text(scene("E1: contact that is released", "column-tri-16.msh", case))
    for kind in ("tri", "quad"):
        mesh = f"../catalogue/square-{kind}-16.msh"
        title = "L(0.55): a flux between two ends, all three states"
        (LIMITS / f"l-{kind}.toml").write_text(scene(title, mesh, case_l("x", "y")))


main()
