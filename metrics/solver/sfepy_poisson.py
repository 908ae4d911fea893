#!/usr/bin/env python3
"""The problem poisson of cbc3d-solve, solved by SfePy: sfepy_poisson.py MESH.txt ORDER X0 Y0 Z0 LONGEST_SIDE

MESH.txt: counts of vertices and tets; x y z per vertex; four vertices and the label per tet. Prints the relative H1 and L2
errors and the number of unknowns. Shares nothing with cbc3d-solve but the statement of the problem (manufactured.hpp).
"""
import sys

import numpy as np
from sfepy.base.base import output
from sfepy.discrete import (Equation, Equations, FieldVariable, Function, Integral, Material, Problem)
from sfepy.discrete.common.mappings import get_physical_qps
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field, Mesh
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.terms import Term

output.set_output(quiet=True)


def read(path):
    numbers = np.array(open(path).read().split(), dtype=float)
    vertices, tets = numbers[:2].astype(int)
    points = numbers[2:2 + 3 * vertices].reshape(-1, 3)
    cells = numbers[2 + 3 * vertices:].reshape(tets, 5).astype(np.int32)
    return Mesh.from_data("mesh", points, None, [cells[:, :4].copy()], [cells[:, 4].copy()], ["3_4"])


def main():
    path, order = sys.argv[1], int(sys.argv[2])
    origin, side = np.array(sys.argv[3:6], dtype=float), float(sys.argv[6])
    wave = 4 * np.pi / 3 / side

    def exact(x):
        return np.prod(np.cos(wave * (x - origin)), axis=1)

    def gradient(x):
        c, s = np.cos(wave * (x - origin)), np.sin(wave * (x - origin))
        return -wave * np.stack([s[:, 0] * c[:, 1] * c[:, 2], c[:, 0] * s[:, 1] * c[:, 2],
                                 c[:, 0] * c[:, 1] * s[:, 2]], axis=1)

    def conductivity(label):
        return np.choose(label % 3, [.25, 1.0, 4.0])

    mesh = read(path)
    domain = FEDomain("domain", mesh)
    omega = domain.create_region("Omega", "all")
    gamma = domain.create_region("Gamma", "vertices of surface", "facet")
    field = Field.from_args("field", np.float64, "scalar", omega, approx_order=order)
    u, v = FieldVariable("u", "unknown", field), FieldVariable("v", "test", field, primary_var_name="u")
    # More quadrature than cbc3d-solve has, so that its is checked too.
    integral = Integral("i", order=8)
    labels = mesh.cmesh.cell_groups

    def coefficients(ts, coors, mode=None, **kwargs):
        if mode != "qp":
            return None
        sigma = np.repeat(conductivity(labels), len(coors) // len(labels))[:, None]
        return {"sigma": sigma[:, :, None], "flux": (sigma * gradient(coors))[:, :, None]}

    material = Material("m", function=Function("coefficients", coefficients))
    stiffness = Term.new("dw_laplace(m.sigma, v, u)", integral, omega, m=material, v=v, u=u)
    source = Term.new("dw_diffusion_r(m.flux, v)", integral, omega, m=material, v=v)
    problem = Problem("poisson", equations=Equations([Equation("balance", stiffness - source)]))
    at_boundary = Function("exact", lambda ts, coors, bc=None, problem=None, **kwargs: exact(coors))
    problem.set_bcs(ebcs=Conditions([EssentialBC("held", gamma, {"u.all": at_boundary})]))
    problem.set_solver(Newton({"i_max": 1, "eps_a": 1e-12}, lin_solver=ScipyDirect({})))
    problem.solve(save_results=False)
    u = problem.get_variables()["u"]

    places = get_physical_qps(omega, integral).values
    weights = field.get_mapping(omega, integral, "volume")[0].det.ravel()
    slopes = u.evaluate(mode="grad", integral=integral, region=omega).reshape(-1, 3)
    values = u.evaluate(mode="val", integral=integral, region=omega).ravel()
    true_slopes, true_values = gradient(places), exact(places)

    def norm(squares):
        return np.sqrt((weights * squares).sum())

    print("%.10g %.10g %d" % (norm(((slopes - true_slopes) ** 2).sum(1)) / norm((true_slopes ** 2).sum(1)),
                              norm((values - true_values) ** 2) / norm(true_values ** 2),
                              problem.equations.variables.adi.ptr[-1]))


main()
