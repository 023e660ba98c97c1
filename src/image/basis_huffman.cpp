#include "image/basis_huffman.hpp"

#include <algorithm>

namespace cotan {

std::uint32_t BasisBits::takeBit()
{
    if (at_ >= 8 * bytes_.size()) {
        failed_ = true;
        return 0;
    }
    const std::uint32_t bit = std::uint32_t(bytes_[at_ / 8]) >> at_ % 8 & 1;
    ++at_;
    return bit;
}

std::uint32_t BasisBits::take(int count)
{
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i)
        value |= takeBit() << i;
    return value;
}

std::uint32_t BasisBits::takeGroups(int bits)
{
    std::uint64_t value = 0;
    for (int at = 0; at < 32; at += bits) {
        value |= std::uint64_t(take(bits)) << at;
        if (takeBit() == 0)
            return std::uint32_t(value);
    }
    failed_ = true;
    return 0;
}

HuffmanTable BasisBits::tableOf(std::span<const std::uint8_t> lengths)
{
    HuffmanTable table;
    for (const std::uint8_t length : lengths)
        ++table.counts[length];
    const std::size_t used = lengths.size() - table.counts[0];
    table.counts[0] = 0;
    int free = 1; // codes of this length that no shorter code begins
    for (std::size_t length = 1; length < table.counts.size(); ++length)
        free = 2 * free - table.counts[length];
    // Only one symbol alone may leave codes without a meaning. Overfull lengths make `free` negative for good.
    if (used == 0 || (free != 0 && used != 1)) {
        failed_ = true;
        return table;
    }
    table.symbols.reserve(used);
    for (std::size_t length = 1; length < table.counts.size(); ++length)
        for (std::size_t symbol = 0; table.counts[length] > 0 && symbol < lengths.size(); ++symbol)
            if (lengths[symbol] == length)
                table.symbols.push_back(std::uint16_t(symbol));
    return table;
}

HuffmanTable BasisBits::takeTable()
{
    constexpr std::array<std::uint8_t, 21> kOrder{17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                  11, 4,  12, 3,  13, 2, 14, 1, 15, 16};
    constexpr std::uint32_t kShortZeros = 17, kLongZeros = 18, kShortRepeat = 19;
    const std::uint32_t total = take(14);
    if (total == 0)
        return {};
    std::array<std::uint8_t, kOrder.size()> ofLengths{};
    const std::uint32_t stored = take(5);
    if (stored > kOrder.size())
        failed_ = true;
    for (std::size_t i = 0; i < std::min<std::size_t>(stored, kOrder.size()); ++i)
        ofLengths[kOrder[i]] = std::uint8_t(take(3));
    const HuffmanTable codes = tableOf(ofLengths);
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < total && !failed_) {
        const std::uint32_t symbol = take(codes);
        if (symbol < kShortZeros) {
            lengths.push_back(std::uint8_t(symbol));
        } else if (symbol <= kLongZeros) {
            const std::uint32_t run = symbol == kShortZeros ? 3 + take(3) : 11 + take(7);
            lengths.insert(lengths.end(), run, 0);
        } else {
            const std::uint32_t run = symbol == kShortRepeat ? 3 + take(2) : 7 + take(7);
            if (lengths.empty() || lengths.back() == 0)
                failed_ = true;
            else
                lengths.insert(lengths.end(), run, std::uint8_t(lengths.back()));
        }
    }
    if (lengths.size() != total)
        failed_ = true;
    return failed_ ? HuffmanTable{} : tableOf(lengths);
}

std::uint32_t BasisBits::take(const HuffmanTable& table)
{
    // Codes of one length are consecutive numbers, which follow those of shorter codes.
    int code = 0, first = 0, index = 0;
    for (std::size_t length = 1; length < table.counts.size() && !table.symbols.empty(); ++length) {
        const int count = table.counts[length];
        code |= int(takeBit());
        if (code - first < count)
            return table.symbols[std::size_t(index + code - first)];
        index += count;
        first = (first + count) << 1;
        code <<= 1;
    }
    failed_ = true;
    return 0;
}

} // namespace cotan
