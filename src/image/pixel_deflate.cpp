#include "pixel_deflate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>
#include <utility>

namespace cotan {

namespace {

// The alphabets of RFC 1951, 3.2.5 to 3.2.7.
constexpr std::size_t kLiteralSymbols = 286, kDistanceSymbols = 30, kLengthSymbols = 19, kEnd = 256;
constexpr unsigned kMaxBits = 15, kMaxLengthBits = 7, kMaxDistance = 32768;
constexpr std::size_t kBlockBytes = 1 << 17; // of rows, about
constexpr unsigned kHashBits = 12;

struct Code {
    std::uint32_t bits = 0; // the first in the lowest
    std::uint32_t count = 0;
};

// The lengths of Huffman codes for symbols that occur so often, 0 for those that do not. A code that needs more than
// `limit` bits is shortened at the expense of others, which costs next to nothing.
void setLengths(std::span<const std::uint32_t> counts, unsigned limit, std::span<std::uint8_t> lengths)
{
    std::fill(lengths.begin(), lengths.end(), std::uint8_t(0));
    std::array<std::uint16_t, kLiteralSymbols> symbols; // by their counts
    std::size_t used = 0;
    for (std::size_t s = 0; s < counts.size(); ++s)
        if (counts[s] > 0)
            symbols[used++] = std::uint16_t(s);
    if (used < 2) { // some decoders expect two codes
        const std::size_t one = used == 1 ? symbols[0] : 0;
        lengths[one] = lengths[one == 0 ? 1 : 0] = 1;
        return;
    }
    std::sort(symbols.begin(), symbols.begin() + std::ptrdiff_t(used),
              [&](std::uint16_t a, std::uint16_t b) { return std::pair(counts[a], a) < std::pair(counts[b], b); });
    // Leaves in this order, then the nodes above them, whose counts grow too.
    std::array<std::uint64_t, 2 * kLiteralSymbols> sums;
    std::array<std::uint16_t, 2 * kLiteralSymbols> above;
    for (std::size_t i = 0; i < used; ++i)
        sums[i] = counts[symbols[i]];
    const std::size_t nodes = 2 * used - 1;
    for (std::size_t node = used, leaf = 0, inner = used; node < nodes; ++node) {
        const auto least = [&] {
            return leaf < used && (inner == node || sums[leaf] <= sums[inner]) ? leaf++ : inner++;
        };
        const std::size_t a = least(), b = least();
        above[a] = above[b] = std::uint16_t(node);
        sums[node] = sums[a] + sums[b];
    }
    std::array<std::uint16_t, 2 * kLiteralSymbols> depths;
    depths[nodes - 1] = 0;
    std::array<std::uint32_t, kMaxBits + 1> ofDepth{}; // number of codes of each length
    for (std::size_t i = nodes - 1; i-- > 0;) {
        depths[i] = std::uint16_t(depths[above[i]] + 1);
        if (i < used)
            ++ofDepth[std::min<std::size_t>(depths[i], limit)];
    }
    std::uint64_t room = 0; // that the codes take, of 2^limit
    for (unsigned d = 1; d <= limit; ++d)
        room += std::uint64_t(ofDepth[d]) << (limit - d);
    for (; room > std::uint64_t(1) << limit; --room) { // moves a code below another one
        unsigned d = limit - 1;
        while (ofDepth[d] == 0)
            --d;
        --ofDepth[d];
        ofDepth[d + 1] += 2;
        --ofDepth[limit];
    }
    for (std::size_t i = 0, d = limit; i < used; ++i) { // the rarest first
        while (ofDepth[d] == 0)
            --d;
        --ofDepth[d];
        lengths[symbols[i]] = std::uint8_t(d);
    }
}

void setCodes(std::span<const std::uint8_t> lengths, std::span<Code> codes)
{
    std::array<std::uint32_t, kMaxBits + 1> used{}, next{}; // by length: the number of codes, and the next one
    for (const std::uint8_t length : lengths)
        used[length] += length > 0;
    for (unsigned d = 1; d <= kMaxBits; ++d)
        next[d] = 2 * (next[d - 1] + used[d - 1]);
    for (std::size_t s = 0; s < lengths.size(); ++s) {
        codes[s] = {0, lengths[s]};
        std::uint32_t code = next[lengths[s]]++;
        for (unsigned bit = 0; bit < lengths[s]; ++bit, code >>= 1)
            codes[s].bits = codes[s].bits << 1 | (code & 1);
    }
}

// The symbol of a length or distance, and the bits that follow it.
struct Symbol {
    std::uint32_t symbol, extra, count;
};

// Symbols of twice as many values each, `fine` of them per doubling.
Symbol symbolOf(std::uint32_t value, unsigned fineBits)
{
    const unsigned top = unsigned(std::bit_width(value)) - 1; // value has at least 1 + fineBits bits
    const unsigned count = top - fineBits;
    return {(count << fineBits) + (value >> count), value & ((1u << count) - 1), count};
}
Symbol lengthSymbol(std::uint32_t length)
{
    if (length == 258)
        return {285, 0, 0};
    if (length < 7)
        return {254 + length, 0, 0};
    Symbol s = symbolOf(length - 3, 2);
    s.symbol += 257;
    return s;
}
Symbol distanceSymbol(std::uint32_t distance)
{
    return distance < 3 ? Symbol{distance - 1, 0, 0} : symbolOf(distance - 1, 1);
}

std::uint64_t load(const std::uint8_t* from)
{
    std::uint64_t bytes;
    std::memcpy(&bytes, from, sizeof bytes);
    if constexpr (std::endian::native == std::endian::big)
        bytes = __builtin_bswap64(bytes);
    return bytes;
}

class BitWriter {
public:
    explicit BitWriter(std::uint8_t* to) : to_(to) {}
    void put(std::uint32_t bits, unsigned count)
    {
        pending_ |= std::uint64_t(bits) << count_;
        count_ += count;
    }
    void put(Code code) { put(code.bits, code.count); }
    // At most 57 bits may be put between two calls.
    void flush()
    {
        for (unsigned k = 0; k < 8; ++k) // one store
            to_[k] = std::uint8_t(pending_ >> (8 * k));
        to_ += count_ / 8;
        pending_ >>= count_ & ~7u;
        count_ &= 7;
    }
    // Fills up the last byte.
    std::uint8_t* end()
    {
        count_ = (count_ + 7) & ~7u;
        flush();
        return to_;
    }

private:
    std::uint8_t* to_;
    std::uint64_t pending_ = 0;
    unsigned count_ = 0;
};

// Bytes as they are, then a repetition of earlier ones.
struct MatchStep {
    std::uint32_t literals;
    std::uint16_t length, distance; // 0: none
};

class DeflateBlocks {
public:
    DeflateBlocks(const std::uint8_t* rows, std::vector<std::uint8_t>& packed) : rows_(rows), packed_(packed) {}

    template<std::size_t Pixel> void addRow(std::size_t from, std::size_t to)
    {
        constexpr std::size_t kKeyBytes = Pixel == 3 ? 6 : Pixel == 6 ? 6 : 8;
        constexpr std::uint64_t kKey = kKeyBytes == 6 ? (std::uint64_t(1) << 48) - 1 : ~std::uint64_t(0);
        const std::uint8_t* const p = rows_;
        ++counts_[0][p[from]];
        ++literals_;
        for (std::size_t i = from + 1; i < to;) {
            std::size_t distance = 0;
            if (i + kKeyBytes <= to) {
                const std::uint64_t key = load(p + i) & kKey;
                if (i > from + Pixel && key == (load(p + i - Pixel) & kKey)) {
                    distance = Pixel;
                } else {
                    std::uint32_t& last = last_[key * 0x9e3779b97f4a7c15u >> (64 - kHashBits)];
                    const std::size_t off = i - std::exchange(last, std::uint32_t(i));
                    if (off <= kMaxDistance && key == (load(p + i - off) & kKey))
                        distance = off;
                }
            }
            if (distance == 0) {
                for (std::size_t k = 0; k < Pixel; ++k)
                    ++counts_[k % 4][p[i + k]];
                literals_ += Pixel;
                i += Pixel;
                continue;
            }
            const std::size_t most = std::min<std::size_t>(258 / Pixel * Pixel, to - i);
            std::size_t length = kKeyBytes;
            for (std::uint64_t differing = 0; length < most && differing == 0;) {
                differing = load(p + i + length) ^ load(p + i + length - distance);
                length += differing == 0 ? 8 : std::size_t(std::countr_zero(differing)) / 8;
            }
            add(std::min(length, most) / Pixel * Pixel, distance);
            i += std::min(length, most) / Pixel * Pixel;
        }
        if (to - begun_ >= kBlockBytes)
            endBlock(to);
    }

    void endBlock(std::size_t to)
    {
        if (literals_ > 0)
            steps_.push_back({std::exchange(literals_, 0), 0, 0});
        std::array<std::uint32_t, kLiteralSymbols> counts{};
        for (std::size_t s = 0; s < kEnd; ++s)
            counts[s] = counts_[0][s] + counts_[1][s] + counts_[2][s] + counts_[3][s];
        std::copy(lengths_.begin(), lengths_.end(), counts.begin() + kEnd);
        counts[kEnd] = 1;
        std::array<std::uint8_t, kLiteralSymbols + kDistanceSymbols> lengths;
        const std::span<std::uint8_t> ofLiterals(lengths.data(), kLiteralSymbols),
            ofDistances(&lengths[kLiteralSymbols], kDistanceSymbols);
        setLengths(counts, kMaxBits, ofLiterals);
        setLengths(distances_, kMaxBits, ofDistances);
        std::array<Code, kLiteralSymbols> literalCodes;
        std::array<Code, kDistanceSymbols> distanceCodes;
        setCodes(ofLiterals, literalCodes);
        setCodes(ofDistances, distanceCodes);
        block_.resize(std::max(block_.size(), 1024 + 2 * (to - begun_))); // each literal takes 15 bits at most
        BitWriter bits(block_.data());
        bits.put(2u << 1, 3); // not the last block; own codes
        putLengths(lengths, bits);
        const std::uint8_t* next = rows_ + begun_;
        for (const MatchStep& step : steps_) {
            std::uint32_t i = 0;
            for (; i + 3 <= step.literals; i += 3, next += 3) {
                bits.put(literalCodes[next[0]]);
                bits.put(literalCodes[next[1]]);
                bits.put(literalCodes[next[2]]);
                bits.flush();
            }
            for (; i < step.literals; ++i)
                bits.put(literalCodes[*next++]);
            bits.flush();
            if (step.length == 0)
                continue;
            const Symbol length = lengthSymbol(step.length), distance = distanceSymbol(step.distance);
            bits.put(literalCodes[length.symbol]);
            bits.put(length.extra, length.count);
            bits.put(distanceCodes[distance.symbol]);
            bits.put(distance.extra, distance.count);
            bits.flush();
            next += step.length;
        }
        bits.put(literalCodes[kEnd]);
        bits.put(0, 3); // a stored block of no bytes ends on a whole byte
        std::uint8_t* const end = bits.end();
        packed_.insert(packed_.end(), block_.data(), end);
        packed_.insert(packed_.end(), {0, 0, 0xff, 0xff});
        steps_.clear();
        counts_ = {};
        lengths_ = {};
        distances_ = {};
        begun_ = to;
    }

private:
    void add(std::size_t length, std::size_t distance)
    {
        ++lengths_[lengthSymbol(std::uint32_t(length)).symbol - kEnd];
        ++distances_[distanceSymbol(std::uint32_t(distance)).symbol];
        steps_.push_back({std::exchange(literals_, 0), std::uint16_t(length), std::uint16_t(distance)});
    }

    // Writes the lengths of the codes, themselves coded.
    static void putLengths(std::span<const std::uint8_t> lengths, BitWriter& bits)
    {
        constexpr std::uint8_t kOrder[kLengthSymbols] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                         11, 4,  12, 3, 13, 2, 14, 1, 15};
        struct Run { // of equal lengths as a symbol, and the bits that follow it
            std::uint8_t symbol, extra, count;
        };
        std::vector<Run> runs;
        std::array<std::uint32_t, kLengthSymbols> counts{};
        for (std::size_t i = 0; i < lengths.size();) {
            std::size_t zeros = 0;
            while (zeros < 138 && i + zeros < lengths.size() && lengths[i + zeros] == 0)
                ++zeros;
            runs.push_back(zeros > 10      ? Run{18, std::uint8_t(zeros - 11), 7}
                               : zeros > 2 ? Run{17, std::uint8_t(zeros - 3), 3}
                                           : Run{lengths[i], 0, 0});
            ++counts[runs.back().symbol];
            i += zeros > 2 ? zeros : 1;
        }
        std::array<std::uint8_t, kLengthSymbols> ofRuns;
        std::array<Code, kLengthSymbols> codes;
        setLengths(counts, kMaxLengthBits, ofRuns);
        setCodes(ofRuns, codes);
        bits.put(unsigned(kLiteralSymbols - 257), 5);
        bits.put(unsigned(kDistanceSymbols - 1), 5);
        bits.put(unsigned(kLengthSymbols - 4), 4);
        for (const std::uint8_t symbol : kOrder) {
            bits.put(ofRuns[symbol], 3);
            bits.flush();
        }
        for (const Run& run : runs) {
            bits.put(codes[run.symbol]);
            bits.put(run.extra, run.count);
            bits.flush();
        }
    }

    const std::uint8_t* rows_;
    std::vector<std::uint8_t>& packed_;
    std::size_t begun_ = 0; // where the block begins
    std::vector<MatchStep> steps_;
    std::uint32_t literals_ = 0;                             // since the last step
    std::array<std::array<std::uint32_t, 256>, 4> counts_{}; // of literals; several, so that none waits for another
    std::array<std::uint32_t, kLiteralSymbols - kEnd> lengths_{}; // counts of symbols
    std::array<std::uint32_t, kDistanceSymbols> distances_{};
    std::array<std::uint32_t, 1 << kHashBits> last_{}; // where a pixel of each hash began
    std::vector<std::uint8_t> block_;
};

} // namespace

void deflatePixels(std::span<const std::uint8_t> rows, std::size_t rowBytes, std::size_t pixelBytes,
                   std::vector<std::uint8_t>& packed)
{
    DeflateBlocks blocks(rows.data(), packed);
    for (std::size_t from = 0; from < rows.size(); from += rowBytes)
        switch (pixelBytes) {
        case 3: blocks.addRow<3>(from, from + rowBytes); break;
        case 4: blocks.addRow<4>(from, from + rowBytes); break;
        case 6: blocks.addRow<6>(from, from + rowBytes); break;
        default: blocks.addRow<8>(from, from + rowBytes);
        }
    blocks.endBlock(rows.size());
}

} // namespace cotan
