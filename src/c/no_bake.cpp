// cotan.h: baking, where there is no part `bake`.
#include "call.hpp"
#include "core/not_built.hpp"

using namespace cotan;
using namespace cotan::c;

cotan_status cotan_bake(const cotan_mesh*, const cotan_mesh*, const cotan_bake_options*, cotan_picture*,
                        cotan_bake_result*, char* message, size_t message_size)
{
    return refused(notBuiltWith("Embree", "libembree-dev"), message, message_size);
}

cotan_status cotan_bake_models(const cotan_model*, size_t, const cotan_model* const*, const cotan_bake_options*,
                               cotan_picture*, cotan_bake_result*, cotan_bytes**, char* message, size_t message_size)
{
    return refused(notBuiltWith("Embree", "libembree-dev"), message, message_size);
}
