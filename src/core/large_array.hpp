// Large arrays that are written before they are read, for which page faults would take a large fraction of the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#if __has_include(<sys/mman.h>) && !defined(__EMSCRIPTEN__) // elsewhere malloc is used, and zeros are written
#include <sys/mman.h>
#endif

namespace cotan {

inline constexpr std::size_t kLarge = 8u << 20; // bytes, four large pages; malloc often has smaller blocks ready

// Requests large pages for the memory, which makes the first access several times faster.
inline void requestLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
    constexpr std::size_t kPage = 4096;
    const std::size_t skipped = (kPage - reinterpret_cast<std::uintptr_t>(memory) % kPage) % kPage;
    if (bytes >= kLarge)
        ::madvise(static_cast<char*>(memory) + skipped, bytes - skipped, MADV_HUGEPAGE);
#endif
}

struct FreeLargeArray {
    std::size_t mapped = 0; // bytes mapped from the system; 0: from malloc

    void operator()(void* memory) const
    {
#ifdef MADV_HUGEPAGE
        if (mapped > 0) {
            ::munmap(memory, mapped);
            return;
        }
#endif
        std::free(memory);
    }
};

template<class T> using LargeArray = std::unique_ptr<T[], FreeLargeArray>;

// Returns an uninitialised array. Large ones are mapped from the system, because malloc keeps memory that other threads
// free.
template<class T> LargeArray<T> makeLargeArray(std::size_t size)
{
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    const std::size_t bytes = size * sizeof(T);
#ifdef MADV_HUGEPAGE
    if (bytes >= kLarge) {
        void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED)
            throw std::bad_alloc();
        requestLargePages(memory, bytes);
        return LargeArray<T>(static_cast<T*>(memory), {bytes});
    }
#endif
    void* const memory = std::malloc(bytes);
    if (memory == nullptr && bytes > 0)
        throw std::bad_alloc();
    return LargeArray<T>(static_cast<T*>(memory), {});
}

// Returns a vector of zeros in large pages.
template<class T> std::vector<T> zeros(std::size_t size)
{
    std::vector<T> out;
    out.reserve(size);
    requestLargePages(out.data(), size * sizeof(T));
    out.resize(size);
    return out;
}

} // namespace cotan
