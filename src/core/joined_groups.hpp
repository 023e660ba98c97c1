#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cotan {

// Numbers from 0 on in groups that grow by joining (union-find). A group is known by its lowest number.
class JoinedGroups {
public:
    explicit JoinedGroups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t number)
    {
        while (parent_[number] != number)
            number = parent_[number] = parent_[parent_[number]];
        return number;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace cotan
