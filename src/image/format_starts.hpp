// The formats that OpenImageIO reads, by how their files begin: one list for all who ask.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace cotan {

struct FormatStart {
    std::string_view start;
    std::string_view name; // OpenImageIO's
    bool rows;             // are read a few at a time
};

// Null for others: TGA, which begins in no way of its own, and what nothing knows.
inline const FormatStart* formatStart(std::span<const std::byte> bytes)
{
    using namespace std::string_view_literals;
    static constexpr std::array<FormatStart, 9> kStarts = {{{"\xff\xd8\xff"sv, "jpeg", false},
                                                            {"II*\0"sv, "tiff", true},
                                                            {"MM\0*"sv, "tiff", true},
                                                            {"II+\0"sv, "tiff", true}, // BigTIFF
                                                            {"MM\0+"sv, "tiff", true},
                                                            {"\x76\x2f\x31\x01"sv, "openexr", true},
                                                            {"#?"sv, "hdr", true},
                                                            {"BM"sv, "bmp", false},
                                                            {"DDS "sv, "dds", false}}};
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto found = std::ranges::find_if(kStarts, [&](const FormatStart& f) { return head.starts_with(f.start); });
    return found == kStarts.end() ? nullptr : &*found;
}

} // namespace cotan
