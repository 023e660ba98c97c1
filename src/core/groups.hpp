// Disjoint sets of numbers, and lists of items by group.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cotan {

// Numbers from 0 on in groups that are joined (union-find). The lowest number of a group identifies it.
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

// Lists items by group: those of group g are items[begin[g]] to items[begin[g + 1] - 1], in the order in which they are
// added. each(add) calls add(group, item) for every item; it is called twice.
template<class Index, class Item>
void listByGroup(std::size_t groups, const auto& each, std::vector<Index>& begin, std::vector<Item>& items)
{
    begin.assign(groups + 2, 0); // shifted by one: while items are added, each begin advances to the next
    each([&](std::size_t group, const Item&) { ++begin[group + 2]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    items.resize(begin.back());
    each([&](std::size_t group, const Item& item) { items[begin[group + 1]++] = item; });
    begin.pop_back();
}

} // namespace cotan
