#include "cost/spirv_count.hpp"

namespace cotan::cost {

int spirvInstructions(std::span<const std::uint32_t> words)
{
    // Opcodes of the SPIR-V specification, section 3.49.
    constexpr std::uint32_t kMagic = 0x07230203, kNop = 0, kLine = 8, kFunction = 54, kFunctionEnd = 56, kVariable = 59,
                            kLabel = 248, kNoLine = 317;
    constexpr std::size_t kHeaderWords = 5;
    if (words.size() < kHeaderWords || words[0] != kMagic)
        return 0;
    int count = 0;
    bool inside = false;
    for (std::size_t at = kHeaderWords; at < words.size();) {
        const std::uint32_t code = words[at] & 0xffffu;
        const std::uint32_t length = words[at] >> 16;
        if (length == 0 || at + length > words.size())
            return 0;
        at += length;
        if (code == kFunction || code == kFunctionEnd)
            inside = code == kFunction;
        else if (inside && code != kNop && code != kLine && code != kVariable && code != kLabel && code != kNoLine)
            ++count;
    }
    return count;
}

} // namespace cotan::cost
