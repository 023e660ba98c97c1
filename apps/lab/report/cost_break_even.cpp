#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cost/choices.hpp"
#include "cost_markdown.hpp"

namespace cotan {

using namespace cost;

namespace {

std::string ratio(double pixels)
{
    return std::isinf(pixels) ? "always" : pixels <= 0 ? "never" : fmt::format("{:.2f}", pixels);
}

// Extra instructions of the vertex stage for a stored tangent.
std::optional<double> tangentAtVertex(const DeviceCode& d)
{
    const auto with = vertexCode(d, Stored::tangent).instructions;
    const auto without = vertexCode(d, Stored::nothing).instructions;
    return with && without ? std::optional(*with - *without) : std::nullopt;
}

std::string byVertex(const CostReport& report)
{
    const auto devices = devicesWith(report, &StageCode::instructions);
    Table table = tableOf({"wins below ... pixels per vertex", "in bytes"}, devices);
    const int tangentBytes = vertexStage(Stored::tangent).bytes;
    for (const Row* row : report.rows) {
        if (row->stored != Stored::nothing || row->name == "floor" || isHistorical(*row))
            continue;
        std::vector<std::string> line = {std::string(row->name),
                                         ratio(pixelsPerVertex(tangentBytes, row->bytesPerPixel))};
        for (const DeviceCode* d : devices) {
            const auto mine = fragmentCode(*d, row->name).instructions,
                       mikktspace = fragmentCode(*d, "mikktspace").instructions, vertex = tangentAtVertex(*d);
            line.push_back(mine && mikktspace && vertex ? ratio(pixelsPerVertex(*vertex, *mine - *mikktspace)) : "-");
        }
        table.push_back(std::move(line));
    }
    return "### Pixels per vertex below which tangent-free costs less than `mikktspace`\n\n" + aligned(table);
}

std::string range(const PixelRange& r)
{
    if (r.above == r.below)
        return "never";
    return !std::isinf(r.below) ? "below " + pixelsText(r.below)
        : r.above > 0           ? "above " + pixelsText(r.above)
                                : "always";
}

std::string byTriangle(const CostReport& report)
{
    const auto devices = devicesWith(report, &StageCode::inverseThroughput);
    Table table = tableOf({"wins where triangles cover ... pixels", "vertices per triangle"}, devices);
    for (const Choice& choice : choices()) {
        if (&choice == &choices().front())
            continue;
        std::vector<std::string> line = {std::string(choice.name), fmt::format("{:.2f}", choice.verticesPerTriangle)};
        for (const DeviceCode* d : devices) {
            const auto stored = trianglePrice(*d, choices().front()), mine = trianglePrice(*d, choice);
            line.push_back(stored && mine ? range(cheaperRange(*mine, *stored)) : "-");
        }
        table.push_back(std::move(line));
    }
    return "### Pixels per triangle where it costs less than `mikktspace`, in inverse throughput\n\n" + aligned(table);
}

} // namespace

std::string pixelsText(double pixels)
{
    return pixels < 1  ? fmt::format("{:.2f}", pixels)
        : pixels < 100 ? fmt::format("{:.1f}", pixels)
                       : fmt::format("{:.0f}", pixels);
}

std::string breakEven(const CostReport& report) { return byVertex(report) + byTriangle(report); }

} // namespace cotan
