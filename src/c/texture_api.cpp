// cotan.h: normal maps as textures of blocks.
#include "maps/textures/make_texture.hpp"
#include "readable_map.hpp"

using namespace cotan;
using namespace cotan::c;

cotan_status cotan_map_texture(const cotan_image_view* map, const cotan_texture_options* options,
                               cotan_texture_result* result, cotan_bytes** texture, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_texture_options o = optionsOf(options, "options");
        require(texture, "texture: expected a pointer, found null");
        if (result)
            checked(result, "result");
        const auto wordOr = [](const char* given, const char* otherwise) {
            return std::string(given ? given : otherwise);
        };
        const std::string container = wordOr(o.container, "ktx2");
        if (container != "ktx2" && container != "dds")
            fail(ErrorKind::usage, "options.container: expected ktx2 or dds, found '", container, "'");
        ReadableMap read = readableMap(map, "map", o.from ? o.from : "gltf,exact", "options.from", o.to, "options.to");
        requireStorable(read.from, "options.from", read.image.type);
        read.image.frame = o.frame ? name(frameOr(o.frame, {}, "options.frame")) : "";
        const maps::TextureSettings settings{
            read.from,   read.to,       wordOr(o.compress, "none"), wordOr(o.swizzle, "auto"), "map." + container,
            o.mips != 0, read.normalise};
        maps::MadeTexture made = valueOf(maps::makeTexture(std::move(read.image), settings));
        if (result) {
            result->levels = made.levels;
            result->mean_degrees = made.cost ? made.cost->mean : -1;
            result->percentile99_degrees = made.cost ? made.cost->percentile99 : -1;
        }
        *texture = new cotan_bytes{std::move(made.bytes)};
    });
}
