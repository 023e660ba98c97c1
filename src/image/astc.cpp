#include "image/astc.hpp"

#include <atomic>
#include <memory>

#include <astcenc.h>
#include <fmt/format.h>

#include "core/loops.hpp"
#include "core/try.hpp"

namespace cotan {

namespace {

struct FreeContext {
    void operator()(astcenc_context* context) const { astcenc_context_free(context); }
};
using Context = std::unique_ptr<astcenc_context, FreeContext>;

Error failed(astcenc_error code)
{
    return unavailableError(fmt::format("libastcenc: {}", astcenc_get_error_string(code)));
}

Result<Context> open(int width, int height, float effort, unsigned flags, unsigned threads)
{
    astcenc_config config{};
    astcenc_error code =
        astcenc_config_init(ASTCENC_PRF_LDR, unsigned(width), unsigned(height), 1, effort, flags, &config);
    // Before 5.2 the library keeps two values of its first context for all later ones. Their defaults depend on the
    // block size: without one value for all, the blocks would depend on what the process has encoded before.
    [](auto& tuned) {
        if constexpr (requires { tuned.tune_mode0_mse_overshoot; })
            tuned.tune_mode0_mse_overshoot = tuned.tune_refinement_mse_overshoot = 3.5f;
    }(config);
    astcenc_context* context = nullptr;
    if (code == ASTCENC_SUCCESS)
        code = astcenc_context_alloc(&config, threads, &context);
    if (code != ASTCENC_SUCCESS)
        return failed(code);
    return Context(context);
}

astcenc_image viewOf(const Image& image, void*& data, astcenc_type type)
{
    data = const_cast<std::byte*>(image.data.data());
    return {unsigned(image.width), unsigned(image.height), 1, type, &data};
}

} // namespace

bool readsAstc() { return true; }

Status decodeAstc(int width, int height, std::span<const std::byte> blocks, Image& image)
{
    COTAN_TRY(context, open(width, height, ASTCENC_PRE_FASTEST, ASTCENC_FLG_DECOMPRESS_ONLY, 1));
    void* data = nullptr;
    astcenc_image to = viewOf(image, data, ASTCENC_TYPE_U8);
    const astcenc_swizzle asStored{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    const astcenc_error code = astcenc_decompress_image(
        context->get(), reinterpret_cast<const std::uint8_t*>(blocks.data()), blocks.size(), &to, &asStored, 0);
    return code == ASTCENC_SUCCESS ? Status(Done{}) : failed(code);
}

Result<std::vector<std::byte>> encodeAstc(int width, int height, const Image& image, AstcChannels channels)
{
    const unsigned threads = unsigned(threadsFor(image.pixelCount(), 1 << 14));
    COTAN_TRY(context,
              open(width, height, ASTCENC_PRE_MEDIUM, channels == AstcChannels::greyAlpha ? ASTCENC_FLG_MAP_NORMAL : 0,
                   threads));
    void* data = nullptr;
    astcenc_image from = viewOf(image, data, ASTCENC_TYPE_F32);
    const astcenc_swizzle swizzle = channels == AstcChannels::greyAlpha
        ? astcenc_swizzle{ASTCENC_SWZ_R, ASTCENC_SWZ_R, ASTCENC_SWZ_R, ASTCENC_SWZ_G}
        : channels == AstcChannels::alphaGreen
        ? astcenc_swizzle{ASTCENC_SWZ_1, ASTCENC_SWZ_G, ASTCENC_SWZ_1, ASTCENC_SWZ_R}
        : astcenc_swizzle{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    const std::size_t across = std::size_t((image.width + width - 1) / width),
                      down = std::size_t((image.height + height - 1) / height);
    std::vector<std::byte> blocks(across * down * 16);
    std::atomic<astcenc_error> code = ASTCENC_SUCCESS;
    // Every thread enters the library with its own number, and the library shares the blocks out among them.
    runTasks(threads, threads, [&](std::size_t thread) {
        const astcenc_error here =
            astcenc_compress_image(context->get(), &from, &swizzle, reinterpret_cast<std::uint8_t*>(blocks.data()),
                                   blocks.size(), unsigned(thread));
        if (here != ASTCENC_SUCCESS)
            code = here;
    });
    if (code != ASTCENC_SUCCESS)
        return failed(code);
    return blocks;
}

} // namespace cotan
