// Bits and Huffman codes of BasisLZ streams (KTX 2.0 specification, appendix "BasisLZ/ETC1S Bitstream").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cotan {

// Symbols by canonical Huffman codes of up to 16 bits, as those of Deflate (RFC 1951, 3.2.2).
struct HuffmanTable {
    std::array<std::uint16_t, 17> counts{}; // of codes, by their length
    std::vector<std::uint16_t> symbols;     // by code
};

// Reads a stream from the lowest bit of its first byte upwards.
class BasisBits {
public:
    explicit BasisBits(std::span<const std::byte> bytes) : bytes_(bytes) {}

    // Past the end of the stream, bits are 0 and failed() is true. count: at most 16.
    std::uint32_t take(int count);

    // A number in groups of `bits`, lowest first; the bit after each says whether more follow. More than 32 bits fail.
    std::uint32_t takeGroups(int bits);

    // A table as it is stored: the lengths of its codes, themselves coded. A table without symbols is valid; what is no
    // prefix code fails.
    HuffmanTable takeTable();

    // The symbol of the next code; 0 and failed() if the table has none.
    std::uint32_t take(const HuffmanTable& table);

    // Whether what was read is not in the stream or is invalid.
    bool failed() const { return failed_; }

private:
    std::uint32_t takeBit();
    HuffmanTable tableOf(std::span<const std::uint8_t> lengths);

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0; // bit
    bool failed_ = false;
};

} // namespace cotan
