#include <algorithm>

#include <fmt/format.h>

#include "cost_markdown.hpp"

namespace cotan {

using namespace cost;

namespace {

struct Against {
    int cheaper = 0, equal = 0;
    double minExtra = 0, maxExtra = 0; // range of cost differences to stored tangents; negative: cheaper
    std::vector<std::string> dearer;
    int cards() const { return cheaper + equal + int(dearer.size()); }
};

// `read` returns the value of a row on a GPU, or nothing if there is none.
template<class Read> Against against(const CostReport& report, std::string_view form, const Read& read)
{
    Against result;
    for (const DeviceCode& d : report.code) {
        const std::optional<double> stored = read(d, "mikktspace"), mine = read(d, form);
        if (!stored || !mine)
            continue;
        const double more = *mine - *stored;
        const bool first = result.cards() == 0;
        result.minExtra = first ? more : std::min(result.minExtra, more);
        result.maxExtra = first ? more : std::max(result.maxExtra, more);
        if (more > 0)
            result.dearer.push_back(title(d));
        else
            ++(more < 0 ? result.cheaper : result.equal);
    }
    return result;
}

void addLine(Table& table, std::string stage, std::string_view form, const Against& a)
{
    if (a.cards() == 0)
        return;
    std::string dearer;
    for (const std::string& card : a.dearer)
        dearer += (dearer.empty() ? "" : ", ") + card;
    if (a.dearer.size() > 6)
        dearer = fmt::format("{} GPUs", a.dearer.size());
    table.push_back({std::move(stage), std::string(form), fmt::format("{:+.4g} to {:+.4g}", a.minExtra, a.maxExtra),
                     fmt::format("{}", a.cards()), fmt::format("{}", a.cheaper), fmt::format("{}", a.equal),
                     dearer.empty() ? "none" : dearer});
}

} // namespace

std::string againstStored(const CostReport& report)
{
    Table table = {{"stage", "form", "more than `mikktspace`", "GPUs", "less on", "equal on", "more on"}};
    for (const std::string_view form :
         {"smooth-fused", "triangle-halfs", "triangle-fused", "triangle-read", "cotangent-seen", "cotangent-fused"})
        addLine(table, "forward, instructions", form,
                against(report, form,
                        [](const DeviceCode& d, std::string_view row) { return fragmentCode(d, row).instructions; }));
    for (const std::string_view form : {"smooth-fused", "triangle-halfs", "triangle-fused", "triangle-read"})
        addLine(table, "forward, bound in cycles", form,
                against(report, form, [](const DeviceCode& d, std::string_view row) {
                    return fragmentCode(d, row).inverseThroughput;
                }));
    for (const std::string_view form : {"triangle-read", "triangle-fused", "smooth-fused", "cotangent-fused"})
        addLine(table, "visibility buffer, instructions", form,
                against(report, form,
                        [](const DeviceCode& d, std::string_view row) { return resolveCode(d, row).instructions; }));
    return table.size() < 2 ? "" : "### Against stored tangents, over all GPUs\n\n" + aligned(table);
}

} // namespace cotan
