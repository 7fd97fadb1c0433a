"""Writes OSQP's embedded code for a bounded problem: python3 osqp_workspace.py QUADRATIC.h FOLDER

The host library scales nothing (the diagonals are near 1), factors once in f64, and its own generator
writes the workspace in f32 (embedded mode 1: only vectors change, no allocation, no factorisation).
"""

import re
import sys

import numpy
import osqp
import scipy.sparse

# Tried on the problems without limits: rho from 0.2 to 1.6, alpha 1.6 and 1.8, a check every 1, 3, 5, 10 steps.
# These take the fewest instructions for an error of about 1e-4.
PRIMAL = {"rho": 0.4, "alpha": 1.6, "check_termination": 10, "eps_abs": 3e-5, "eps_rel": 0}
# The same on those with limits: rho from 0.2 to 3.2, alpha from 1 to 1.8, a check every 5 and 10 steps, the inverse as it is
# and with a unit diagonal.
DUAL = {"rho": 2.4, "alpha": 1.4, "check_termination": 5, "eps_abs": 3e-5, "eps_rel": 0}


def array(text, name):
    """The numbers of an array in the header."""
    entries = re.search(rf"\b{name}\[[^]]*\]\s*=\s*\{{(.*?)\}}", text, re.DOTALL).group(1)
    numbers = [entry.strip() for entry in entries.split(",") if entry.strip()]
    return numpy.array([float(number.removesuffix("f")) for number in numbers])


def main(header, folder):
    with open(header, encoding="utf-8") as file:
        text = file.read()
    lower, upper = array(text, "LEAST"), array(text, "MOST")
    size = len(lower)
    h = array(text, "H").reshape(size, size)
    solver = osqp.OSQP(algebra="builtin")
    solver.setup(
        P=scipy.sparse.csc_matrix(numpy.triu(h)),
        q=numpy.zeros(size),
        A=scipy.sparse.eye(size, format="csc"),
        l=lower,
        u=upper,
        scaling=0,
        adaptive_rho=0,
        check_dualgap=False,
        warm_starting=True,
        max_iter=1000,
        verbose=False,
        **(DUAL if re.search(r"#define IS_DUAL 1", text) else PRIMAL),
    )
    options = {"parameters": "vectors", "use_float": True, "extension_name": None}
    solver.codegen(folder, force_rewrite=True, **options)


main(*sys.argv[1:])
