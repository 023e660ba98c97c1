// cotan.h: models, where there is no part `gltf`.
#include "call.hpp"
#include "cotan/not_built.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

Error noGltf() { return notBuiltWith("glTF", "nlohmann-json3-dev, libfmt-dev, libpng-dev and libjpeg-dev"); }

} // namespace

cotan_status cotan_lint_gltf(const void*, size_t, const cotan_model_files*, const cotan_lint_options*,
                             cotan_lint_result*, cotan_bytes**, char* message, size_t message_size)
{
    return refused(noGltf(), message, message_size);
}

cotan_status cotan_convert_gltf(const void*, size_t, const cotan_model_files*, const cotan_convert_options*,
                                cotan_convert_result*, cotan_bytes**, cotan_bytes**, char* message, size_t message_size)
{
    return refused(noGltf(), message, message_size);
}
