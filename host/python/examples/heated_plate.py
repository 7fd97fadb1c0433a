# %% [markdown]
# # From a geometry to a controller
# A plate of aluminium with a hole lies in moving air. A heater along its lower side keeps it at 2 °C or more, and gives only as much heat
# as that takes. We mesh it with Gmsh, solve it, refine where the error bound says, and bake the controller for a microcontroller.
#
# Run it with `python heated_plate.py`, or cell by cell. It needs `pip install "./host/python[plot]" gmsh`.

# %%
import gmsh
import numpy as np

import signorini

# %% [markdown]
# ## The geometry
# Lines and arcs in metres. Boundaries get their names from physical groups.

# %%
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
plate = gmsh.model.occ.addRectangle(0, 0, 0, 0.2, 0.08)
hole = gmsh.model.occ.addDisk(0.13, 0.045, 0, 0.02, 0.02)
gmsh.model.occ.cut([(2, plate)], [(2, hole)])
gmsh.model.occ.synchronize()
sides = {"heater": [], "air": [], "hole": []}
for _, curve in gmsh.model.getEntities(1):
    x, y, _ = gmsh.model.occ.getCenterOfMass(1, curve)
    if abs(y) < 1e-9:
        sides["heater"].append(curve)
    elif np.hypot(x - 0.13, y - 0.045) < 0.021:
        sides["hole"].append(curve)
    else:
        sides["air"].append(curve)
for name, curves in sides.items():
    gmsh.model.addPhysicalGroup(1, curves, name=name)
gmsh.model.mesh.setSize(gmsh.model.getEntities(0), 0.01)
gmsh.model.mesh.generate(2)

# %% [markdown]
# ## The mesh as arrays

# %%
tags, coordinates, _ = gmsh.model.mesh.getNodes()
number = np.zeros(tags.max() + 1, dtype=int)
number[tags] = np.arange(len(tags))
points = coordinates.reshape(-1, 3)[:, :2]
triangles = number[gmsh.model.mesh.getElementsByType(2)[1]].reshape(-1, 3)
edges = {}
for name, curves in sides.items():
    ends = [gmsh.model.mesh.getElementsByType(1, curve)[1] for curve in curves]
    edges[name] = number[np.concatenate(ends)].reshape(-1, 2)
gmsh.finalize()
mesh = (points, {"triangle": triangles}, edges)

# %% [markdown]
# ## The scene
# The temperature of the air is an input with a range, so that much can be proved for all of it.

# %%
scene = {
    "title": "a heated plate: temperature [degC], heat [W/m]",
    "material": {"default": {"conductivity": 160}},
    "boundary": {
        "heater": {"kind": "contact", "gap": 2},
        "air": {"kind": "robin", "coefficient": 25, "ambient": 0},
        "hole": {"kind": "neumann", "flux": 0},
    },
    "input": {
        "air": {"of": "air", "field": "ambient", "pattern": 1, "default": -10, "range": [-30, 10], "unit": "degC"},
    },
    "output": {
        "power": {"kind": "force", "of": "heater", "unit": "W/m"},
        "skin": {"kind": "mean", "of": "air", "unit": "degC"},
    },
}
result = signorini.solve(scene, mesh)
power = result.outputs["power"]
print(result)
print(f"power {power.center:.1f} ± {power.plus_minus:.2g} W/m, guaranteed")

# %% [markdown]
# ## As exact as asked for

# %%
finer = signorini.solve(scene, mesh, max_error="1%")
power = finer.outputs["power"]
print(finer)
print(f"power {power.center:.2f} ± {power.plus_minus:.2g} W/m, guaranteed")
assert finer.relative_bound < 0.01 and power.plus_minus < result.outputs["power"].plus_minus

# %% [markdown]
# ## A picture

# %%
finer.plot().figure.savefig("heated_plate.png", dpi=150)

# %% [markdown]
# ## The controller
# This is the model that firmware gets, with the bits of the device.

# %%
controller = signorini.Controller(scene, mesh)
print(controller)
for air in (-30, -10, 1, 10):
    answer = controller(air=air)
    least, most = answer.between['power']
    print(f"air {air:4d} °C: {answer['power']:7.1f} W/m, between {least:.1f} and {most:.1f}")
assert controller(air=10)["power"] == 0

# %% [markdown]
# ## The firmware
# A module in Rust, or with `signorini bake SCENE --c DIR` a library for C.

# %%
baked = signorini.bake(scene, mesh)
baked.save("heated_plate.rs")
print(f"{baked.chosen['model']}, {baked.chosen['scalar']}: {baked.chosen['flash_bytes']} bytes of flash")
