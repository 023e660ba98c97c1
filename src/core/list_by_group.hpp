// Items in groups, in two arrays.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace cotan {

// Lists items by group: those of group g are items[begin[g]] to items[begin[g + 1] - 1], in the order in which they
// come. each(add) calls add(group, item) for all of them; it is called twice.
template<class Index, class Item>
void listByGroup(std::size_t groups, const auto& each, std::vector<Index>& begin, std::vector<Item>& items)
{
    begin.assign(groups + 2, 0); // one behind, so that every end, counted up, becomes the next one's beginning
    each([&](std::size_t group, const Item&) { ++begin[group + 2]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    items.resize(begin.back());
    each([&](std::size_t group, const Item& item) { items[begin[group + 1]++] = item; });
    begin.pop_back();
}

} // namespace cotan
