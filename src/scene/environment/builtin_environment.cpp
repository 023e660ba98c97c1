#include "cotan/view.hpp"

#include <glm/gtc/packing.hpp>

#include "core/loops.hpp"
#include "prefilter.hpp"

// The assembler embeds the file; as an array in a source file it would take seconds to compile.
__asm__(COTAN_STUDIO_SECTION "\n"
                             ".balign 2\n"
                             ".globl cotanStudioHalfs\n"
                             "cotanStudioHalfs:\n"
                             ".incbin \"" COTAN_STUDIO_FILE "\"\n" COTAN_STUDIO_AFTER "\n");
extern "C" const std::uint16_t cotanStudioHalfs[];

namespace cotan {

namespace {

using namespace environment;

EnvironmentMap storedStudio()
{
    EnvironmentMap map;
    map.name = "studio";
    map.atlas = makeImage(COTAN_ENVIRONMENT_WIDTH, COTAN_ENVIRONMENT_HEIGHT, PixelType::float32, "environment");
    parallelFor(0, COTAN_ENVIRONMENT_HEIGHT, [&](int y) {
        const std::size_t first = std::size_t(y) * COTAN_ENVIRONMENT_WIDTH;
        const std::uint16_t* half = cotanStudioHalfs + kChannels * first;
        float* texel = map.atlas.floats() + 4 * first;
        for (int x = 0; x < COTAN_ENVIRONMENT_WIDTH; ++x, half += kChannels, texel += 4) {
            for (int c = 0; c < kChannels; ++c)
                texel[c] = glm::unpackHalf1x16(half[c]);
            texel[3] = 1;
        }
    });
    return map;
}

} // namespace

std::optional<EnvironmentMap> builtinEnvironment(const std::string& name, const EnvironmentOptions& options)
{
    const auto radiance = builtinRadiance(name);
    if (!radiance)
        return std::nullopt;
    if (name == "studio" && options.rotation == 0 && options.intensity == 1)
        return storedStudio();
    EnvironmentMap map = makeEnvironment(*radiance, 1, options);
    map.name = name;
    return map;
}

} // namespace cotan
