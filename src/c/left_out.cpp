// cotan.h: replacements for functions whose part is not built (CMakeLists.txt), which return an error.
#include "call.hpp"
#include "core/not_built.hpp"

using namespace cotan;
using namespace cotan::c;

#define COTAN_REFUSES(missing, function, ...)                                                                          \
    cotan_status function(__VA_ARGS__, char* message, size_t message_size)                                             \
    {                                                                                                                  \
        return refused(missing(), message, message_size);                                                              \
    }

#ifdef COTAN_WITHOUT_BAKE
static Error embree() { return notBuiltWith("Embree", "libembree-dev"); }

COTAN_REFUSES(embree, cotan_bake, const cotan_mesh*, const cotan_mesh*, const cotan_bake_options*, cotan_image_view*,
              cotan_bake_result*)
COTAN_REFUSES(embree, cotan_bake_models, const cotan_model*, size_t, const cotan_model* const*,
              const cotan_bake_options*, cotan_image_view*, cotan_bake_result*, cotan_bytes**)
COTAN_REFUSES(embree, cotan_bake_maps, const cotan_model*, size_t, const cotan_model* const*, const cotan_bake_options*,
              size_t, const char* const*, cotan_image_view* const*, cotan_bake_result* const*, cotan_bytes**,
              cotan_bytes**)
COTAN_REFUSES(embree, cotan_pair_names, size_t, const char* const*, size_t, const char* const*, int64_t*, int64_t*,
              cotan_bytes**)

const char* cotan_name_role(const char*) { return ""; }
#endif

#ifdef COTAN_WITHOUT_TEXTURES
static Error textures() { return notBuiltWith("textures", "libfmt-dev, libpng-dev and libjpeg-dev"); }

COTAN_REFUSES(textures, cotan_map_texture, const cotan_image_view*, const cotan_texture_options*, cotan_texture_result*,
              cotan_bytes**)
#endif

#ifdef COTAN_WITHOUT_GLTF
static Error gltf() { return notBuiltWith("glTF", "nlohmann-json3-dev, libfmt-dev, libpng-dev and libjpeg-dev"); }

COTAN_REFUSES(gltf, cotan_lint_gltf, const void*, size_t, const cotan_model_files*, const cotan_lint_options*,
              cotan_lint_result*, cotan_bytes**)
COTAN_REFUSES(gltf, cotan_lint_model, const cotan_model*, const cotan_lint_options*, cotan_lint_result*, cotan_bytes**)
COTAN_REFUSES(gltf, cotan_convert_gltf, const void*, size_t, const cotan_model_files*, const cotan_convert_options*,
              cotan_convert_result*, cotan_bytes**, cotan_bytes**)
COTAN_REFUSES(gltf, cotan_gltf_images, const void*, size_t, const cotan_model_files*, int, cotan_take_file, void*)
COTAN_REFUSES(gltf, cotan_convert_begin, const void*, size_t, const cotan_model_files*, const cotan_convert_options*,
              cotan_convert_result*, cotan_conversion**)
COTAN_REFUSES(gltf, cotan_conversion_image, const cotan_conversion*, size_t, cotan_image_view*)
COTAN_REFUSES(gltf, cotan_conversion_set, cotan_conversion*, size_t, const void*, size_t)
COTAN_REFUSES(gltf, cotan_convert_end, cotan_conversion*, cotan_bytes**, cotan_bytes**)

size_t cotan_conversion_count(const cotan_conversion*) { return 0; }
void cotan_conversion_free(cotan_conversion*) {}
#endif

#ifdef COTAN_WITHOUT_FILES
static Error files() { return notBuiltWith("files", "libfmt-dev, nlohmann-json3-dev, libpng-dev and libjpeg-dev"); }

COTAN_REFUSES(files, cotan_model_open, const char*, int, int, cotan_model**)
COTAN_REFUSES(files, cotan_set_reader, size_t, const char* const*)
COTAN_REFUSES(files, cotan_image_read, const char*, int, cotan_image**)
COTAN_REFUSES(files, cotan_image_write, const char*, const cotan_image_view*)
COTAN_REFUSES(files, cotan_render, const void*, size_t, const cotan_model_files*, const cotan_render_options*,
              cotan_image**, cotan_bytes**)

int cotan_reader_process(void) { return COTAN_UNAVAILABLE; }
#endif
