// cotan.h: models, where there is no part `gltf`.
#include "call.hpp"
#include "core/not_built.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

Error noGltf() { return notBuiltWith("glTF", "nlohmann-json3-dev, libfmt-dev, libpng-dev and libjpeg-dev"); }

} // namespace

#define COTAN_REFUSES(function, ...)                                                                                   \
    cotan_status function(__VA_ARGS__, char* message, size_t message_size)                                             \
    {                                                                                                                  \
        return refused(noGltf(), message, message_size);                                                               \
    }

COTAN_REFUSES(cotan_lint_gltf, const void*, size_t, const cotan_model_files*, const cotan_lint_options*,
              cotan_lint_result*, cotan_bytes**)
COTAN_REFUSES(cotan_lint_model, const cotan_model*, const cotan_lint_options*, cotan_lint_result*, cotan_bytes**)
COTAN_REFUSES(cotan_convert_gltf, const void*, size_t, const cotan_model_files*, const cotan_convert_options*,
              cotan_convert_result*, cotan_bytes**, cotan_bytes**)
COTAN_REFUSES(cotan_gltf_pictures, const void*, size_t, const cotan_model_files*, int, cotan_take_file, void*)
COTAN_REFUSES(cotan_convert_begin, const void*, size_t, const cotan_model_files*, const cotan_convert_options*,
              cotan_convert_result*, cotan_conversion**)

size_t cotan_conversion_count(const cotan_conversion*) { return 0; }

COTAN_REFUSES(cotan_conversion_picture, const cotan_conversion*, size_t, cotan_picture*)
COTAN_REFUSES(cotan_conversion_set, cotan_conversion*, size_t, const void*, size_t)
COTAN_REFUSES(cotan_convert_end, cotan_conversion*, cotan_bytes**, cotan_bytes**)

void cotan_conversion_free(cotan_conversion*) {}
