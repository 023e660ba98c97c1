// Numbers of a file in memory, lowest byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace cotan {

class LittleEndian {
public:
    explicit LittleEndian(std::span<const std::byte> bytes) : bytes_(bytes) {}

    // 0 to 8 bytes. What lies behind the end is 0, and `past` is set.
    std::uint64_t at(std::uint64_t offset, std::size_t bytes)
    {
        if (offset > bytes_.size() || bytes > bytes_.size() - offset) {
            past = true;
            return 0;
        }
        std::uint64_t value = 0;
        for (std::size_t i = bytes; i-- > 0;)
            value = value << 8 | std::to_integer<std::uint64_t>(bytes_[std::size_t(offset) + i]);
        return value;
    }

    // Whether the bytes from there are these letters.
    bool says(std::uint64_t offset, std::string_view letters) const
    {
        return offset <= bytes_.size() && letters.size() <= bytes_.size() - offset
            && std::string_view(reinterpret_cast<const char*>(bytes_.data()) + offset, letters.size()) == letters;
    }

    std::uint64_t size() const { return bytes_.size(); }

    bool past = false;

private:
    std::span<const std::byte> bytes_;
};

} // namespace cotan
