"""Melted surfaces: closed, outward, of the right volume; parts that add up."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from nao_sim.people.actors.mesh_cutting import Mesh, outward_normals, split
from nao_sim.people.actors.surface import RoundCone, melt_cones, smooth_union

FRAME = np.hstack([np.eye(3), np.zeros((3, 1))])


def cone(a, b, radii):
    return RoundCone("body", "part", np.array(a, float), np.array(b, float), radii, np.ones(3), FRAME)


def volume(vertices, faces):
    corner = vertices[faces]
    return np.einsum("ij,ij->i", corner[:, 0], np.cross(corner[:, 1], corner[:, 2])).sum() / 6


def area(vertices, faces):
    corner = vertices[faces]
    return np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1).sum() / 2


def edge_counts(faces):
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return np.unique(edges, axis=0, return_counts=True)[1]


@settings(max_examples=15, deadline=None)
@given(radius=st.floats(0.05, 0.3), length=st.floats(0.0, 0.5))
def test_capsule_is_closed_and_has_its_volume(radius, length):
    vertices, faces = melt_cones([cone([0, 0, 0], [0, 0, length], (radius, radius))], radius / 7, 0.01)
    assert set(edge_counts(faces)) == {2}
    assert np.isclose(volume(vertices, faces), np.pi * radius**2 * (length + 4 / 3 * radius), rtol=0.03)


def test_a_lone_distance_stays_and_a_union_only_grows():
    rng = np.random.default_rng(0)
    distances = rng.normal(0, 0.1, (3, 50))
    assert np.allclose(smooth_union(distances[:1], 0.02), distances[0])
    union = smooth_union(distances, 0.02)
    assert (union <= distances.min(axis=0) + 1e-12).all()
    assert (union >= distances.min(axis=0) - 0.02 / 4 * np.log(3) - 1e-12).all()


def test_normals_of_a_ball_point_outwards():
    vertices, faces = melt_cones([cone([0, 0, 0], [0, 0, 1e-6], (0.2, 0.2))], 0.03, 0.01)
    normals = outward_normals(Mesh(vertices, faces))
    assert (np.einsum("ij,ij->i", normals, vertices) > 0.19).all()


def test_parts_share_the_area_and_meet_on_the_line_between_them():
    vertices, faces = melt_cones([cone([0, 0, -0.2], [0, 0, 0.2], (0.1, 0.1))], 0.023, 0.01)
    mesh = Mesh(vertices, faces)
    mesh = Mesh(vertices, faces, outward_normals(mesh), np.ones((len(vertices), 1)))
    height = vertices[:, 2]
    parts = dict(split(mesh, np.stack([0.03 - height, height - 0.03])))
    assert set(parts) == {0, 1}
    assert np.isclose(sum(area(p.vertices, p.faces) for p in parts.values()), area(vertices, faces), rtol=1e-9)
    assert parts[0].vertices[:, 2].min() > 0.03 - 1e-9
    assert parts[1].vertices[:, 2].max() < 0.03 + 1e-9
