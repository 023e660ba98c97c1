"""The structs and functions of src/c/include/cotan.h for ctypes. Tests compare them with the header."""

import ctypes as c

size_t, text, pointer, integer, double = c.c_size_t, c.c_char_p, c.c_void_p, c.c_int, c.c_double
handle = c.c_void_p  # a pointer to an object of the library

Progress = c.CFUNCTYPE(integer, pointer, double)


class Struct(c.Structure):
    """A struct of the header, which begins with its own size."""

    def __init__(self, **values):
        super().__init__(size=c.sizeof(type(self)), **values)


def _fields(*groups):
    return [("size", size_t)] + [(name, kind) for kind, names in groups for name in names.split()]


class SurfacePoints(Struct):
    _fields_ = _fields((size_t, "count"), (pointer, "normals dpdx dpdy duvdx duvdy"))


class InterpolatedPoints(Struct):
    _fields_ = _fields((size_t, "count"), (pointer, "normals tangents cotangents_u cotangents_v"))


class CMesh(Struct):
    _fields_ = _fields(
        (size_t, "vertex_count"),
        (pointer, "positions normals texcoords"),
        (size_t, "index_count"),
        (pointer, "indices colors"),
    )


class ImageView(Struct):
    _fields_ = _fields((integer, "width height bits"), (pointer, "pixels"))


class CGreen(Struct):
    _fields_ = _fields((integer, "direction swapped confidence"), (double, "agreement"), (c.c_char * 256, "reason"))


class CMapInfo(Struct):
    _fields_ = _fields(
        (c.c_char * 64, "content"),
        (integer, "zero srgb"),
        (double, "background invalid below_horizon mean_length mean_tilt"),
        (double * 3, "mean"),
    )


class TextureOptions(Struct):
    _fields_ = _fields((text, "from to compress swizzle container frame"), (integer, "mips"))


class TextureResult(Struct):
    _fields_ = _fields((integer, "levels"), (double, "mean_degrees percentile99_degrees"))


class BakeOptions(Struct):
    _fields_ = _fields(
        (text, "frame kind convention"),
        (integer, "samples padding dither occlusion_rays"),
        (c.c_float, "max_distance"),
        (integer, "threads"),
        (Progress, "progress"),
        (pointer, "user"),
        (handle, "cage"),
        (integer, "match_by_name material tile"),
        (text, "tangents high_normals high_frame high_convention"),
        (size_t, "high_map_count"),
        (pointer, "high_maps mask"),
        (c.c_float, "cage_reach"),
        (text, "search"),
        (c.c_float, "extrusion"),
        (text, "occluders"),
        (c.c_float, "thickness_distance curvature_radius"),
        (text, "rays"),
        (text, "id_by"),
        (integer, "wrap"),
        (pointer, "rays_mask"),
    )


class BakeResult(Struct):
    _fields_ = _fields(
        (size_t, "texels covered missed negative twice rays"),
        (double, "ray_distance"),
        (size_t, "further nearer"),
        (double, "ray_start unit"),
        (double * 6, "box"),
        (size_t, "disputed problems"),
    )


bytes_out, size_out = c.POINTER(pointer), c.POINTER(size_t)
Read = c.CFUNCTYPE(integer, pointer, text, bytes_out, size_out)
Decode = c.CFUNCTYPE(integer, pointer, text, pointer, size_t, c.POINTER(ImageView))
Encode = c.CFUNCTYPE(integer, pointer, c.POINTER(ImageView), bytes_out, size_out)
Done = c.CFUNCTYPE(None, pointer)
TakeLevel = c.CFUNCTYPE(integer, pointer, integer, c.POINTER(ImageView), c.POINTER(ImageView))
TakeFile = c.CFUNCTYPE(integer, pointer, text, pointer, size_t)


class ModelFiles(Struct):
    _fields_ = _fields(
        (pointer, "user"),
        (Read, "read"),
        (Decode, "decode"),
        (Encode, "encode"),
        (Done, "done"),
        (text, "name"),
    )


class LintOptions(Struct):
    _fields_ = _fields(
        (double, "distance"), (Progress, "progress"), (pointer, "user"), (double, "limit limit_area"), (text, "frame"),
        (double, "max_degrees"),
    )


class LintResult(Struct):
    _fields_ = _fields(
        (size_t, "primitives maps"),
        (c.c_char * 16, "advice"),
        (size_t, "maps_to_convert"),
        (integer, "distrust_stored"),
        (size_t, "green_against"),
        (double, "orthonormal_degrees cotangent_degrees smooth_degrees"),
        (c.c_char * 1024, "recommendation"),
    )


class ConvertOptions(Struct):
    # `from` is a keyword of Python and must be set by setattr.
    _fields_ = _fields(
        (text, "from to"),
        (integer, "bits keep_tangents generate_tangents threads"),
        (Progress, "progress"),
        (pointer, "user"),
        (text, "expansion"),
        (integer, "keep_maps"),
        (double, "max_degrees"),
    )


class ConvertResult(Struct):
    _fields_ = _fields(
        (size_t, "maps_converted maps_kept primitives_given tangent_bytes_dropped"),
        (double, "worst_degrees_before worst_degrees_after"),
    )


class RenderOptions(Struct):
    _fields_ = _fields(
        (size_t, "word_count"),
        (c.POINTER(text), "words"),
        (integer, "floats threads"),
        (Progress, "progress"),
        (pointer, "user"),
    )


STRUCTS = {
    "cotan_surface_points": SurfacePoints,
    "cotan_interpolated_points": InterpolatedPoints,
    "cotan_mesh": CMesh,
    "cotan_image_view": ImageView,
    "cotan_green": CGreen,
    "cotan_map_info": CMapInfo,
    "cotan_texture_options": TextureOptions,
    "cotan_texture_result": TextureResult,
    "cotan_bake_options": BakeOptions,
    "cotan_bake_result": BakeResult,
    "cotan_model_files": ModelFiles,
    "cotan_lint_options": LintOptions,
    "cotan_lint_result": LintResult,
    "cotan_convert_options": ConvertOptions,
    "cotan_convert_result": ConvertResult,
    "cotan_render_options": RenderOptions,
}

# Argument types of functions that return a cotan_status, without the final `message` and `message_size`.
_STATUS = {
    "cotan_frame_apply": (text, SurfacePoints, pointer, pointer),
    "cotan_frame_encode": (text, SurfacePoints, pointer, pointer),
    "cotan_vertex_frame_apply": (text, InterpolatedPoints, pointer, pointer),
    "cotan_vertex_frame_encode": (text, InterpolatedPoints, pointer, pointer),
    "cotan_tangents": (text, CMesh, integer, pointer),
    "cotan_smooth_cotangents": (CMesh, pointer, pointer),
    "cotan_tangents_with_progress": (text, CMesh, integer, Progress, pointer, pointer),
    "cotan_smooth_cotangents_with_progress": (CMesh, integer, Progress, pointer, pointer, pointer),
    "cotan_split_vertices": (size_t, size_t, pointer, pointer, pointer, pointer, size_out),
    "cotan_split_mirrored": (CMesh, pointer, pointer, size_out),
    "cotan_triangle_vectors": (CMesh, integer, pointer, pointer),
    "cotan_pack_triangles": (size_t, pointer, pointer, pointer),
    "cotan_pack_smooth8": (size_t, pointer, pointer, pointer, pointer),
    "cotan_pack_smooth4": (size_t, pointer, pointer, pointer, pointer),
    "cotan_pack_tangents": (size_t, pointer, pointer, pointer),
    "cotan_provoking": (size_t, size_t, pointer, integer, pointer, pointer, size_out, pointer),
    "cotan_map_green": (ImageView, CGreen),
    "cotan_map_describe": (ImageView, CMapInfo),
    "cotan_map_convert": (ImageView, text, text, ImageView),
    "cotan_map_from_height": (ImageView, double, double, text, ImageView),
    "cotan_map_to_height": (ImageView, text, pointer),
    "cotan_map_blend": (ImageView, ImageView, text, text, double, ImageView),
    "cotan_map_mips": (ImageView, text, double, TakeLevel, pointer),
    "cotan_map_texture": (ImageView, TextureOptions, TextureResult, c.POINTER(handle)),
    "cotan_shader_text": (text, text, text, pointer, size_out),
    "cotan_bake": (CMesh, CMesh, BakeOptions, ImageView, BakeResult),
    "cotan_bake_models": (
        handle, size_t, c.POINTER(handle), BakeOptions, ImageView, BakeResult, c.POINTER(handle),
    ),
    "cotan_bake_maps": (
        handle, size_t, c.POINTER(handle), BakeOptions, size_t, c.POINTER(text), c.POINTER(c.POINTER(ImageView)),
        c.POINTER(c.POINTER(BakeResult)), c.POINTER(handle), c.POINTER(handle),
    ),
    "cotan_file_names": (size_t, c.POINTER(text), size_t, c.POINTER(text), c.POINTER(handle)),
    "cotan_pair_names": (
        size_t, c.POINTER(text), size_t, c.POINTER(text), pointer, pointer, c.POINTER(handle),
    ),
    "cotan_model_open": (text, integer, integer, c.POINTER(handle)),
    "cotan_model_up": (handle, text),
    "cotan_model_of_meshes": (size_t, c.POINTER(c.POINTER(CMesh)), c.POINTER(text), c.POINTER(handle)),
    "cotan_set_reader": (size_t, c.POINTER(text)),
    "cotan_lint_model": (handle, LintOptions, LintResult, c.POINTER(handle)),
    "cotan_image_pixels": (handle, ImageView),
    "cotan_image_read": (text, integer, c.POINTER(handle)),
    "cotan_image_write": (text, ImageView),
    "cotan_render": (pointer, size_t, ModelFiles, RenderOptions, c.POINTER(handle), c.POINTER(handle)),
    "cotan_gltf_images": (pointer, size_t, ModelFiles, integer, TakeFile, pointer),
    "cotan_lint_gltf": (pointer, size_t, ModelFiles, LintOptions, LintResult, c.POINTER(handle)),
    "cotan_convert_gltf": (
        pointer, size_t, ModelFiles, ConvertOptions, ConvertResult, c.POINTER(handle), c.POINTER(handle),
    ),
    "cotan_convert_begin": (pointer, size_t, ModelFiles, ConvertOptions, ConvertResult, c.POINTER(handle)),
    "cotan_conversion_image": (handle, size_t, ImageView),
    "cotan_conversion_set": (handle, size_t, pointer, size_t),
    "cotan_convert_end": (handle, c.POINTER(handle), c.POINTER(handle)),
}  # fmt: skip

# Result and argument types of all other functions.
_OTHERS = {
    "cotan_version": (text,),
    "cotan_api_version": (integer,),
    "cotan_bytes_data": (pointer, handle),
    "cotan_bytes_size": (size_t, handle),
    "cotan_bytes_free": (None, handle),
    "cotan_frame_count": (integer,),
    "cotan_frame_name": (text, integer),
    "cotan_name_role": (text, text),
    "cotan_conversion_count": (size_t, handle),
    "cotan_conversion_free": (None, handle),
    "cotan_model_free": (None, handle),
    "cotan_model_warnings": (text, handle),
    "cotan_image_free": (None, handle),
    "cotan_reader_process": (integer,),
}


def _argument(kind):
    return c.POINTER(kind) if issubclass(kind, Struct) else kind


FUNCTIONS = {name: (integer, *map(_argument, kinds), text, size_t) for name, kinds in _STATUS.items()}
FUNCTIONS.update(_OTHERS)
