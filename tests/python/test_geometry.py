"""Frames and tangents against analytic results for planes."""

import numpy as np
import pytest

import cotan
from shapes import bumps, degrees, square

UP = np.float32([[0, 0, 1]])
TEXEL = np.float32([[0.6, 0.48, 0.64]])
# A plane whose u runs along -x and v along y.
DIFFERENCES = {
    "normals": UP,
    "dpdx": np.float32([[2, 0, 0]]),
    "dpdy": np.float32([[0, 2, 0]]),
    "duvdx": np.float32([[-1, 0]]),
    "duvdy": np.float32([[0, 1]]),
}


def test_frames_lists_the_names():
    assert {"cotangent", "orthonormal", "smooth", "mikktspace", "triangle"} <= set(cotan.frames())


@pytest.mark.parametrize("frame", ["cotangent", "orthonormal", "unit", "exact"])
def test_x_of_a_texel_is_along_u_and_y_along_v(frame):
    normal = cotan.frame_apply(frame, TEXEL, **DIFFERENCES)
    np.testing.assert_allclose(normal, [[-0.6, 0.48, 0.64]], atol=1e-5)
    np.testing.assert_allclose(cotan.frame_encode(frame, normal, **DIFFERENCES), TEXEL, atol=1e-5)


def test_cotangent_frame_scales_slopes_of_stretched_texels():
    # Texels twice as long along u: the slope along u halves.
    stretched = dict(DIFFERENCES, dpdx=np.float32([[4, 0, 0]]))
    normal = cotan.frame_apply("cotangent", TEXEL, **stretched)
    assert degrees(normal[0], [-0.3, 0.48, 0.64]) < 1e-3


def test_vertex_frames_read_the_attributes_of_the_library():
    tangents = np.float32([[-1, 0, 0, 1]])
    normal = cotan.vertex_frame_apply("mikktspace", TEXEL, UP, tangents=tangents)
    # w = 1: cross(n, t) = -y points up in the image, against v, so v runs along y.
    np.testing.assert_allclose(normal, [[-0.6, 0.48, 0.64]], atol=1e-6)
    np.testing.assert_allclose(cotan.vertex_frame_encode("mikktspace", normal, UP, tangents=tangents), TEXEL, atol=1e-6)
    mesh = square()
    u, v = cotan.smooth_cotangents(mesh)
    smooth = cotan.vertex_frame_apply("smooth", np.repeat(TEXEL, 4, 0), mesh.normals, cotangents_u=u, cotangents_v=v)
    np.testing.assert_allclose(smooth, np.repeat([[0.6, -0.48, 0.64]], 4, 0), atol=1e-5)  # v runs against y
    with pytest.raises(cotan.UsageError):
        cotan.vertex_frame_apply("smooth", TEXEL, UP, tangents=tangents)


def test_tangents_follow_u_and_w_the_mirroring():
    assert (cotan.tangents(square()) == [1, 0, 0, 1]).all()
    mirrored = square()
    mirrored.texcoords = mirrored.texcoords * np.float32([-1, 1])
    assert (cotan.tangents(mirrored) == [-1, 0, 0, -1]).all()
    assert (cotan.tangents(square(), kind="vertex")[:, :3] == [1, 0, 0]).all()


def test_only_mikktspace_tangents_are_zero_where_directions_cancel():
    # Opposite directions of u at the origin; the triangle between them has no area in uv.
    positions = np.float32([[0, 0, 0], [1, 0, 0], [0.5, 0.9, 0], [-0.5, 0.9, 0], [-1, 0, 0]])
    texcoords = np.float32([[0, 0], [1, 0], [0, -1], [0, 1], [1, 0]])
    fan = cotan.Mesh(positions, [0, 1, 2, 0, 2, 3, 0, 3, 4], np.repeat(UP, 5, 0), texcoords)
    assert (cotan.tangents(fan)[3] == [0, 0, 0, 1]).all()
    lengths = np.linalg.norm(cotan.tangents(fan)[:, :3], axis=1)
    assert (np.delete(lengths, 3) > 0.999).all()
    np.testing.assert_allclose(np.linalg.norm(cotan.tangents(fan, kind="vertex")[:, :3], axis=1), 1, atol=1e-6)


def test_tangents_do_not_depend_on_threads():
    mesh = bumps()
    assert (cotan.tangents(mesh, threads=1) == cotan.tangents(mesh, threads=4)).all()


def test_vertices_are_split_where_corners_differ():
    corners = np.float32([[0, 1, 0, 1], [1, 0, 0, 1], [1, 0, 0, 1]])
    indices, sources = cotan.split_vertices(2, [0, 0, 1], corners)
    assert indices.tolist() == [0, 2, 1] and sources.tolist() == [0, 1, 0]
    same, kept = cotan.split_mirrored(square())
    assert same.tolist() == square().indices.tolist() and kept.tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize("last, corner", [(False, 0), (True, 2)])
def test_vertex_k_provokes_triangle_k(last, corner):
    indices, sources, corners = cotan.provoking(4, square().indices, last)
    assert indices.reshape(-1, 3)[:, corner].tolist() == [0, 1]
    assert (sources[indices].reshape(-1, 3)[:, corner] == corners.reshape(-1, 3)[:, 0]).all()
    assert (np.sort(sources[indices].reshape(-1, 3)) == np.sort(square().indices.reshape(-1, 3))).all()


def test_triangle_vectors_are_per_triangle_and_pack_as_halves():
    u, v = cotan.triangle_vectors(square())
    assert u.shape == v.shape == (2, 3)
    assert degrees(np.cross([0, 0, 1], u[0]), [1, 0, 0]) < 1e-3  # t = cross(n, U) runs along +u
    np.testing.assert_allclose(u[0], u[1], atol=1e-6)
    words = cotan.pack_triangles(u, v)
    halves = words.view(np.float16).reshape(2, 6).astype(np.float32)
    np.testing.assert_allclose(halves, np.c_[u, v], atol=2e-3)


def test_packed_forms_have_their_shapes():
    mesh = square()
    u, v = cotan.smooth_cotangents(mesh)
    eight = cotan.pack_smooth8(mesh.normals, u, v)
    four = cotan.pack_smooth4(mesh.normals, u, v)
    two = cotan.pack_tangents(mesh.normals, cotan.tangents(mesh)[:4])
    assert (eight.shape, eight.dtype, four.shape, four.dtype, two.shape, two.dtype) == (
        (4, 4), np.int16, (4,), np.uint32, (4,), np.uint16,
    )  # fmt: skip
    assert (eight[0] == eight[3]).all() and eight.any() and four[0] == four[3] != 0 and two[0] == two[3]


def test_shader_text_is_that_of_the_command_line(command, tmp_path):
    for lang in ("glsl", "wgsl", "hlsl"):
        command("shader", "--lang", lang, "--frame", "cotangent", "-o", tmp_path / lang)
        assert cotan.shader(lang, "cotangent") == (tmp_path / lang).read_text()
    command("shader", "--lang", "godot", "-o", tmp_path / "godot", "--preset", "gltf", "--unsigned", "exact")
    assert cotan.shader("godot") == (tmp_path / "godot").read_text()
    with pytest.raises(cotan.UsageError, match="frame: expected orthonormal for maps .*MikkTSpace.*; smooth or cotangent .*; found none"):
        cotan.shader("glsl")
