"""Arrays in and out: which are copied, which are not, and which are refused."""

import numpy as np
import pytest

import cotan
from shapes import bumps, slope, square


def test_fitting_arrays_are_not_copied():
    positions = np.zeros((5, 3), np.float32)
    indices = np.array([0, 1, 2], np.uint32)
    texcoords = np.zeros((5, 2), np.float32)
    mesh = cotan.Mesh(positions, indices, positions, texcoords)
    for given, kept in ((positions, mesh.positions), (positions, mesh.normals), (texcoords, mesh.texcoords)):
        assert kept is given
    assert np.shares_memory(mesh.indices, indices)
    assert mesh._c().positions == positions.ctypes.data and mesh._c().indices == indices.ctypes.data


def test_triangles_of_three_rows_are_not_copied():
    rows = np.array([[0, 1, 2], [2, 1, 0]], np.uint32)
    mesh = cotan.Mesh(np.zeros((3, 3), np.float32), rows)
    assert np.shares_memory(mesh.indices, rows) and mesh.indices.shape == (6,)


def test_fitting_images_are_passed_without_a_copy():
    from cotan import _arrays

    for dtype in (np.uint8, np.uint16, np.float32):
        given = np.zeros((3, 5, 4), dtype)
        assert _arrays.pixels(given) is given
        made = _arrays.image_view(given)
        assert (made.pixels, made.width, made.height, made.bits) == (given.ctypes.data, 5, 3, 8 * given.itemsize)


def test_results_are_written_into_out():
    mesh, out = square(), np.empty((6, 4), np.float32)
    assert cotan.tangents(mesh, out=out) is out and (out[:, 0] == 1).all()
    pixels = np.empty((16, 8, 4), np.uint16)
    baked = cotan.bake(mesh, slope(0), size=(8, 16), bits=16, out=pixels)
    assert baked.map is pixels and (pixels == [32768, 32768, 65535, 65535]).all()
    converted = np.empty((16, 8, 4), np.uint8)
    assert cotan.map_convert(pixels, "gltf", "directx", out=converted) is converted
    assert (converted == [128, 128, 255, 255]).all()
    one = np.float32([[0, 0, 1]])
    assert cotan.frame_apply("cotangent", one, one, [[1, 0, 0]], [[0, 1, 0]], [[1, 0]], [[0, 1]], out=one) is one


@pytest.mark.parametrize(
    "out",
    [
        np.empty((8, 8, 4), np.uint16),
        np.empty((8, 9, 4), np.uint8),
        np.empty((8, 8, 8), np.uint8)[..., ::2],
        np.broadcast_to(np.uint8(0), (8, 8, 4)),
        [0],
    ],
)
def test_unsuitable_out_is_refused(out):
    with pytest.raises(cotan.UsageError, match="^out: expected a contiguous, writeable array") as caught:
        cotan.bake(square(), slope(0), size=8, out=out)
    assert caught.value.field == "out" and caught.value.found


def test_strided_arrays_and_other_dtypes_give_the_same():
    mesh = bumps()
    expected = cotan.tangents(mesh)
    wide = np.zeros((len(mesh.positions), 6), np.float32)
    wide[:, ::2] = mesh.positions
    other = cotan.Mesh(
        wide[:, ::2],
        mesh.indices.astype(np.int64)[::-1][::-1].reshape(-1, 3),
        np.asfortranarray(mesh.normals),
        mesh.texcoords.astype(np.float64).tolist(),
    )
    assert (cotan.tangents(other) == expected).all()
    picture = np.random.default_rng(1).integers(0, 256, (16, 16, 4), np.uint8)
    turned = cotan.map_convert(picture.transpose(1, 0, 2), "gltf", "directx")
    assert (turned == cotan.map_convert(picture.transpose(1, 0, 2).copy(), "gltf", "directx")).all()


def test_three_channels_and_one_get_full_alpha():
    rgb = np.full((4, 4, 3), 128, np.uint8)
    rgb[..., 2] = 255
    assert (cotan.map_convert(rgb, "gltf", "gltf") == [128, 128, 255, 255]).all()
    flat = cotan.map_from_height(np.zeros((4, 4), np.float64), 1.0)
    assert (flat == [128, 128, 255, 255]).all()


def refused(kind, field, call):
    with pytest.raises(kind) as caught:
        call()
    assert "\n" not in str(caught.value)
    assert caught.value.field == field, str(caught.value)
    return caught.value


P, N, UV, I = np.zeros((4, 3), np.float32), np.ones((4, 3), np.float32), np.zeros((4, 2), np.float32), np.zeros(6, np.uint32)


def test_wrong_shapes_and_dtypes_name_argument_expected_and_found():
    error = refused(cotan.UsageError, "positions", lambda: cotan.Mesh(P[:, :2], I))
    assert (error.expected, error.found) == ("shape (n, 3)", "(4, 2)")
    error = refused(cotan.UsageError, "normals", lambda: cotan.Mesh(P, I, N[:3]))
    assert (error.expected, error.found) == ("shape (4, 3)", "(3, 3)")
    error = refused(cotan.UsageError, "texcoords", lambda: cotan.Mesh(P, I, N, UV.astype(complex)))
    assert error.found == "dtype complex128"
    refused(cotan.UsageError, "positions", lambda: cotan.Mesh("abc", I))
    refused(cotan.UsageError, "positions", lambda: cotan.Mesh([[1, 2, 3], [4]], I))
    refused(cotan.UsageError, "positions", lambda: cotan.Mesh(None, I))
    refused(cotan.UsageError, "indices", lambda: cotan.Mesh(P, I.astype(float)))
    refused(cotan.UsageError, "indices", lambda: cotan.Mesh(P, np.zeros((2, 4), int)))
    refused(cotan.InputError, "indices", lambda: cotan.Mesh(P, [0, 1, -1]))
    refused(cotan.InputError, "indices", lambda: cotan.Mesh(P, [0, 1, 1 << 32]))
    refused(cotan.UsageError, "map", lambda: cotan.detect(np.zeros((4, 4, 4), int)))
    refused(cotan.UsageError, "map", lambda: cotan.detect(np.zeros((4, 4, 2), np.uint8)))
    refused(cotan.UsageError, "map", lambda: cotan.detect(np.zeros((0, 4, 4), np.uint8)))
    refused(cotan.UsageError, "low", lambda: cotan.bake(3, square()))
    refused(cotan.UsageError, "high", lambda: cotan.bake(square(), [square(), None]))


def test_errors_of_the_library_have_the_same_parts():
    error = refused(cotan.InputError, "mesh.indices[5]", lambda: cotan.tangents(cotan.Mesh(P, [0, 1, 2, 0, 1, 4], N, UV)))
    assert (error.expected, error.found) == ("less than 4", "4")
    refused(cotan.UsageError, "mesh.index_count", lambda: cotan.tangents(cotan.Mesh(P, [0, 1], N, UV)))
    refused(cotan.UsageError, "mesh", lambda: cotan.tangents(cotan.Mesh(P, I, N)))
    error = refused(cotan.UsageError, "frame", lambda: cotan.bake(square(), slope(0), size=8, frame="nonsense"))
    assert "smooth" in error.expected and error.found == "'nonsense'"
    refused(cotan.UsageError, "kind", lambda: cotan.bake(square(), slope(0), size=8, kind="nonsense"))
    refused(cotan.UsageError, "samples", lambda: cotan.bake(square(), slope(0), size=8, samples=3))
    refused(cotan.UsageError, "max_distance", lambda: cotan.bake(square(), slope(0), size=8, max_distance=-1))
    refused(cotan.UsageError, "size", lambda: cotan.bake(square(), slope(0), size=16385))
    refused(cotan.UsageError, "size", lambda: cotan.bake(square(), slope(0), size=8.5))
    refused(cotan.UsageError, "size", lambda: cotan.bake(square(), slope(0), size="8"))
    refused(cotan.UsageError, "convention", lambda: cotan.bake(square(), slope(0), size=8, convention="nonsense"))


@pytest.mark.parametrize("value", [-2, 2**32, 2**70, 0.5, "8", None, float("nan")])
@pytest.mark.parametrize("field", ["threads", "padding", "ao_rays", "material", "udim", "memory"])
def test_out_of_range_integers_are_refused(field, value):
    files = ("missing.obj", "missing.obj") if field == "memory" else (square(), slope(0))
    if (field, value) == ("udim", None):  # its default
        value = 1000
    refused(cotan.UsageError, field, lambda: cotan.bake(*files, size=8, **{field: value}))


def test_floats_are_finite_numbers():
    for value in (float("nan"), float("inf"), "x", None, [1]):
        refused(cotan.UsageError, "max_distance", lambda: cotan.bake(square(), slope(0), size=8, max_distance=value))
        refused(cotan.UsageError, "cage_reach", lambda: cotan.bake(square(), slope(0), size=8, cage_reach=value))
        refused(cotan.UsageError, "distance", lambda: cotan.lint(cotan.Model(square()), distance=value))
        refused(cotan.UsageError, "scale_x", lambda: cotan.map_from_height(np.zeros((4, 4)), value))


def test_non_finite_numbers_are_refused():
    broken = square()
    broken.positions = broken.positions.copy()
    broken.positions[2, 1] = np.nan
    with pytest.raises(cotan.InputError, match="finite"):
        cotan.bake(broken, slope(0), size=8)
    with pytest.raises(cotan.InputError, match="finite"):
        cotan.bake(square(), broken, size=8)


def test_frames_accept_any_numbers():
    nan = np.full((3, 3), np.nan, np.float32)
    up = np.tile(np.float32([0, 0, 1]), (3, 1))
    zero3, zero2 = np.zeros((3, 3)), np.zeros((3, 2))
    assert (cotan.frame_apply("cotangent", up, up, zero3, zero3, zero2, zero2) == up).all()
    assert cotan.frame_apply("cotangent", up, up, nan, nan, zero2, zero2).shape == (3, 3)


def test_empty_meshes_are_accepted():
    empty = cotan.Mesh(np.zeros((0, 3)), [], np.zeros((0, 3)), np.zeros((0, 2)))
    assert cotan.tangents(empty).shape == (0, 4)
    assert [a.shape for a in cotan.smooth_cotangents(empty)] == [(0, 3), (0, 3)]
    with pytest.raises(cotan.InputError):
        cotan.bake(empty, square(), size=8)
    with pytest.raises(cotan.Error):
        cotan.bake(square(), [], size=8)


def test_errors_survive_pickle():
    import pickle

    error = refused(cotan.UsageError, "positions", lambda: cotan.Mesh(P[:, :2], I))
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and vars(again) == vars(error) and str(again) == str(error)


def test_results_print_in_a_line_and_meshes_compare_by_identity():
    mesh = square("panel")
    assert repr(mesh) == "Mesh(name='panel', vertices=4, triangles=2)"
    assert mesh == mesh and mesh != square("panel") and {mesh: 1}[mesh] == 1
    assert len(repr(cotan.bake(mesh, slope(0), size=64))) < 300


def test_rows_of_different_lengths_are_reported():
    ragged = [[0, 0, 0], [1, 2]]
    for call in (
        lambda: cotan.Mesh(ragged, [0, 1, 2]),
        lambda: cotan.Mesh([[0, 0, 0]], ragged),
        lambda: cotan.map_convert(ragged, "gltf", "gltf"),
    ):
        with pytest.raises(cotan.UsageError, match="found rows of different lengths$"):
            call()
