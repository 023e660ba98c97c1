// Random access to integers and text in a file or in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace cotan {

class Numbers {
public:
    // Reads `bytes` bytes at `offset`, which lie within the file; false on failure.
    using Read = std::function<bool(std::uint64_t offset, void* to, std::size_t bytes)>;

    // bytes: must outlive the object. Little-endian.
    explicit Numbers(std::span<const std::byte> bytes)
        : read_([bytes](std::uint64_t offset, void* to, std::size_t count) {
              std::memcpy(to, bytes.data() + offset, count);
              return true;
          }),
          size_(bytes.size())
    {
    }

    Numbers(Read read, std::uint64_t size, bool bigEndian) : read_(std::move(read)), size_(size), bigEndian_(bigEndian)
    {
    }

    // An unsigned integer of 0 to 8 bytes. Past the end of the file it is 0, and `past` is set.
    std::uint64_t at(std::uint64_t offset, std::size_t bytes)
    {
        std::array<unsigned char, 8> raw{};
        if (offset > size_ || bytes > size_ - offset || !read_(offset, raw.data(), bytes)) {
            past = true;
            return 0;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i)
            value = value << 8 | raw[bigEndian_ ? i : bytes - 1 - i];
        return value;
    }

    // Whether the bytes at `offset` are `letters`.
    bool matches(std::uint64_t offset, std::string_view letters) const
    {
        std::string there(letters.size(), '\0');
        return offset <= size_ && letters.size() <= size_ - offset && read_(offset, there.data(), there.size())
            && there == letters;
    }

    std::uint64_t size() const { return size_; }

    bool past = false;

private:
    Read read_;
    std::uint64_t size_ = 0;
    bool bigEndian_ = false;
};

} // namespace cotan
