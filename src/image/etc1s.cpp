#include "image/etc1s.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/try.hpp"
#include "image/basis_huffman.hpp"
#include "image/etc.hpp"

namespace cotan {

namespace {

struct Endpoint {
    std::array<std::uint8_t, 3> color{}; // 5 bits
    std::uint8_t table = 0;              // of kEtcModifiers
};
using Selector = std::array<std::uint8_t, 4>; // a row of four indices, the left one in the lowest bits

Error damaged(const std::string& part)
{
    return inputError(fmt::format("ETC1S: {} ends too early or has an invalid code", part));
}

Result<std::vector<Endpoint>> readEndpoints(const Etc1sParts& parts)
{
    BasisBits bits(parts.endpoints);
    std::array<HuffmanTable, 3> colorTables; // for previous values to 9, to 21, and above
    for (HuffmanTable& table : colorTables)
        table = bits.takeTable();
    const HuffmanTable tables = bits.takeTable();
    const bool grey = bits.take(1) != 0;
    std::vector<Endpoint> endpoints;
    Endpoint last{{16, 16, 16}, 0};
    for (std::uint32_t i = 0; i < parts.endpointCount && !bits.failed(); ++i) {
        last.table = std::uint8_t((last.table + bits.take(tables)) & 7);
        for (std::size_t c = 0; c < (grey ? 1u : 3u); ++c) {
            std::uint8_t& value = last.color[c];
            value = std::uint8_t((value + bits.take(colorTables[value <= 9 ? 0 : value <= 21 ? 1 : 2])) & 31);
        }
        if (grey)
            last.color[1] = last.color[2] = last.color[0];
        endpoints.push_back(last);
    }
    if (bits.failed())
        return damaged(
            fmt::format("the codebook of {} endpoints in {} bytes", parts.endpointCount, parts.endpoints.size()));
    return endpoints;
}

Result<std::vector<Selector>> readSelectors(const Etc1sParts& parts)
{
    BasisBits bits(parts.selectors);
    if (bits.take(2) != 0)
        return inputError("ETC1S: the first two bits of the selectors are reserved and must be 0");
    const bool plain = bits.take(1) != 0;
    const HuffmanTable table = plain ? HuffmanTable{} : bits.takeTable();
    std::vector<Selector> selectors;
    Selector last{};
    for (std::uint32_t i = 0; i < parts.selectorCount && !bits.failed(); ++i) {
        for (std::uint8_t& row : last)
            row = std::uint8_t(plain || i == 0 ? bits.take(8) : row ^ bits.take(table));
        selectors.push_back(last);
    }
    if (bits.failed())
        return damaged(
            fmt::format("the codebook of {} selectors in {} bytes", parts.selectorCount, parts.selectors.size()));
    return selectors;
}

// What all slices share.
struct Codes {
    std::vector<Endpoint> endpoints;
    std::vector<Selector> selectors;
    HuffmanTable predictions, deltas, selectorCodes, runs;
    std::uint32_t history = 0; // number of recent selectors that have codes of their own
};

Result<Codes> readCodes(const Etc1sParts& parts)
{
    COTAN_TRY(endpoints, readEndpoints(parts));
    COTAN_TRY(selectors, readSelectors(parts));
    Codes codes{*std::move(endpoints), *std::move(selectors), {}, {}, {}, {}, 0};
    BasisBits bits(parts.tables);
    for (HuffmanTable* table : {&codes.predictions, &codes.deltas, &codes.selectorCodes, &codes.runs})
        *table = bits.takeTable();
    codes.history = bits.take(13);
    if (bits.failed())
        return damaged(fmt::format("the part of {} bytes with the tables of its slices", parts.tables.size()));
    return codes;
}

// Recent selectors. Used ones move forward; new ones take turns in the second half.
class History {
public:
    explicit History(std::size_t size) : indices_(size), next_(size / 2) {}

    std::size_t size() const { return indices_.size(); }

    std::uint32_t use(std::size_t i)
    {
        const std::uint32_t index = indices_[i];
        std::swap(indices_[i / 2], indices_[i]);
        return index;
    }

    void add(std::uint32_t index)
    {
        if (indices_.empty())
            return;
        indices_[next_++] = index;
        if (next_ == indices_.size())
            next_ = indices_.size() / 2;
    }

private:
    std::vector<std::uint32_t> indices_;
    std::size_t next_;
};

// The endpoints and selectors of a slice, block by block in rows from the top.
class Slice {
public:
    Slice(const Codes& codes, std::span<const std::byte> bytes, std::size_t across)
        : codes_(codes), bits_(bytes), above_(across), pairs_((across + 1) / 2), history_(codes.history)
    {
    }

    // Returns false if the stream is damaged.
    bool next(std::size_t column, std::size_t row, std::uint32_t& endpoint, std::uint32_t& selector)
    {
        endpoint = takeEndpoint(column, row);
        selector = takeSelector();
        return !bits_.failed() && !wrong_ && endpoint < codes_.endpoints.size() && selector < codes_.selectors.size();
    }

    // Whether a run of sources is longer than the slice.
    bool runsOn() const { return sourceRun_ > 0; }

private:
    // Two bits for each of 2 x 2 blocks say where their endpoint comes from: left, above, above left, or the stream.
    std::uint32_t takeSources()
    {
        constexpr std::uint32_t kRepeat = 256, kLeastRun = 3;
        if (sourceRun_ > 0) {
            --sourceRun_;
            return lastSources_;
        }
        const std::uint32_t symbol = bits_.take(codes_.predictions);
        if (symbol != kRepeat)
            return lastSources_ = symbol;
        sourceRun_ = std::uint64_t(bits_.takeGroups(4)) + kLeastRun - 1;
        return lastSources_;
    }

    std::uint32_t takeEndpoint(std::size_t column, std::size_t row)
    {
        if (column % 2 == 0) {
            sources_ = row % 2 == 0 ? takeSources() : pairs_[column / 2];
            if (row % 2 == 0)
                pairs_[column / 2] = sources_ >> 4;
        }
        const std::uint32_t source = sources_ & 3;
        sources_ >>= 2;
        const std::uint32_t aboveLeft = std::exchange(aboveLeft_, above_[column]);
        wrong_ = wrong_ || (source % 2 == 0 && column == 0) || ((source == 1 || source == 2) && row == 0);
        if (source == 1)
            last_ = above_[column];
        else if (source == 2)
            last_ = aboveLeft;
        else if (source == 3) {
            last_ += bits_.take(codes_.deltas);
            if (last_ >= codes_.endpoints.size())
                last_ -= std::uint32_t(codes_.endpoints.size());
        }
        return above_[column] = last_;
    }

    std::uint32_t takeSelector()
    {
        constexpr std::uint32_t kLeastRun = 3, kLongRun = 63;
        const auto first = std::uint32_t(codes_.selectors.size()); // of the codes for the history
        std::uint32_t symbol = first;
        if (selectorRun_ > 0) {
            --selectorRun_;
        } else {
            symbol = bits_.take(codes_.selectorCodes);
            if (symbol == first + codes_.history) {
                const std::uint32_t run = bits_.take(codes_.runs);
                selectorRun_ = std::uint64_t(run == kLongRun ? bits_.takeGroups(7) : run) + kLeastRun - 1;
                symbol = first;
            }
        }
        if (symbol >= first) {
            wrong_ = wrong_ || symbol - first >= history_.size();
            return wrong_ ? 0 : history_.use(symbol - first);
        }
        history_.add(symbol);
        return symbol;
    }

    const Codes& codes_;
    BasisBits bits_;
    std::vector<std::uint32_t> above_; // endpoints of the last block of each column
    std::vector<std::uint32_t> pairs_; // sources of the odd row, by pairs of columns
    History history_;
    std::uint32_t sources_ = 0, lastSources_ = 0, last_ = 0, aboveLeft_ = 0;
    std::uint64_t sourceRun_ = 0, selectorRun_ = 0;
    bool wrong_ = false; // a block refers to one outside of the slice, or to no selector
};

// The four colours of a block: the endpoint minus the larger and the smaller modifier, and plus each.
std::array<std::array<std::uint8_t, 3>, 4> paletteOf(const Endpoint& endpoint)
{
    const auto& [small, large] = kEtcModifiers[endpoint.table];
    std::array<std::array<std::uint8_t, 3>, 4> palette{};
    std::size_t i = 0;
    for (const int modifier : {-large, -small, small, large}) {
        for (std::size_t c = 0; c < 3; ++c)
            palette[i][c] =
                std::uint8_t(std::clamp((endpoint.color[c] << 3 | endpoint.color[c] >> 2) + modifier, 0, 255));
        ++i;
    }
    return palette;
}

Status decodeSlice(const Codes& codes, std::span<const std::byte> bytes, bool second, Image& image)
{
    const int across = (image.width + 3) / 4, down = (image.height + 3) / 4;
    Slice slice(codes, bytes, std::size_t(across));
    for (int row = 0; row < down; ++row)
        for (int column = 0; column < across; ++column) {
            std::uint32_t endpoint = 0, selector = 0;
            if (!slice.next(std::size_t(column), std::size_t(row), endpoint, selector))
                return inputError(fmt::format("ETC1S: block {}, {} of the {} slice is not in its {} bytes", column, row,
                                              second ? "second" : "first", bytes.size()));
            const auto palette = paletteOf(codes.endpoints[endpoint]);
            for (int y = 0; y < std::min(4, image.height - 4 * row); ++y)
                for (int x = 0; x < std::min(4, image.width - 4 * column); ++x) {
                    const auto& color = palette[std::size_t(codes.selectors[selector][std::size_t(y)] >> 2 * x & 3)];
                    std::uint8_t* to = image.bytes8()
                        + 4 * (std::size_t(4 * row + y) * std::size_t(image.width) + std::size_t(4 * column + x));
                    if (second) {
                        to[3] = color[0];
                    } else {
                        std::copy_n(color.data(), 3, to);
                        to[3] = 255;
                    }
                }
        }
    if (slice.runsOn())
        return inputError(fmt::format("ETC1S: a run of the {} slice has more than its {} x {} blocks",
                                      second ? "second" : "first", across, down));
    return Done{};
}

} // namespace

Status decodeEtc1s(const Etc1sParts& parts, Image& image)
{
    COTAN_TRY(codes, readCodes(parts));
    COTAN_CHECK(decodeSlice(*codes, parts.color, false, image));
    return parts.second.empty() ? Status(Done{}) : decodeSlice(*codes, parts.second, true, image);
}

} // namespace cotan
