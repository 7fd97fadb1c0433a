"""Writes OSQP's embedded code for a condensed problem: python3 osqp_workspace.py PROBLEM.h FOLDER

The host library scales nothing (S has a unit diagonal), factors once in f64, and its own generator
writes the workspace in f32 (embedded mode 1: only vectors change, no allocation, no factorisation).
"""

import re
import sys

import numpy
import osqp
import scipy.sparse

# Tried on the three problems: rho from 0.2 to 1.6, alpha 1.6 and 1.8, a check every 1, 3, 5, 10 steps.
# These take the fewest instructions for an error of about 1e-4.
CHOSEN = {"rho": 0.4, "alpha": 1.6, "check_termination": 10, "eps_abs": 3e-5, "eps_rel": 0}


def matrix(text):
    """The S of the header."""
    size = int(re.search(r"#define N (\d+)", text).group(1))
    entries = re.search(r"\bS\[[^]]*\]\s*=\s*\{(.*?)\}", text, re.DOTALL).group(1)
    numbers = [float(entry.strip().rstrip("fF")) for entry in entries.split(",") if entry.strip()]
    return numpy.array(numbers).reshape(size, size)


def main(header, folder):
    with open(header, encoding="utf-8") as file:
        s = matrix(file.read())
    size = len(s)
    solver = osqp.OSQP(algebra="builtin")
    solver.setup(
        P=scipy.sparse.csc_matrix(numpy.triu(s)),
        q=numpy.zeros(size),
        A=scipy.sparse.eye(size, format="csc"),
        l=numpy.zeros(size),
        u=numpy.full(size, numpy.inf),
        scaling=0,
        adaptive_rho=0,
        check_dualgap=False,
        warm_starting=True,
        max_iter=1000,
        verbose=False,
        **CHOSEN,
    )
    options = {"parameters": "vectors", "use_float": True, "extension_name": None}
    solver.codegen(folder, force_rewrite=True, **options)


main(*sys.argv[1:])
