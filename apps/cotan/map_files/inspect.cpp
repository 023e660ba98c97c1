#include "map_files/inspect.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/maps.hpp"
#include "inspect/angles.hpp"
#include "maps/patches.hpp"
#include "maps/texels.hpp"
#include "stream.hpp"

namespace cotan::app {

using namespace maps;

Result<SurveyedFile> surveyFile(const std::filesystem::path& map, const FileOptions& files)
{
    MapSurvey survey;
    SurveyedFile found;
    for (const auto pass : {&MapSurvey::addFirstPass, &MapSurvey::addSecondPass}) {
        COTAN_TRY(reader, openRows(map, files.limits));
        RowReader& in = **reader;
        found.width = in.width, found.height = in.height, found.type = in.type, found.frame = in.frame,
        found.channels = in.channels;
        const bool second = pass == &MapSurvey::addSecondPass;
        const Status read =
            inOrder(in, partOf(files.progress, second, 2), [&](const Image& strip, int) { (survey.*pass)(strip); });
        if (!read)
            return read.error();
        if (survey.oneColour())
            break;
    }
    found.statistics = survey.finish();
    return found;
}

Result<GreenOfFile> greenOfFile(const std::filesystem::path& map, const FileOptions& files, const Damage& damage)
{
    COTAN_TRY(reader, openRows(map, files.limits));
    RowReader& in = **reader;
    PatchSampler sampler(in.width, in.height, in.type);
    const Status read = inOrder(in, files.progress, [&](const Image& strip, int row) {
        Image undone = damage.any() ? strip : Image();
        undo(damage, undone);
        sampler.add(damage.any() ? undone : strip, row);
    });
    if (!read)
        return read.error();
    return GreenOfFile{greenOf(sampler), sampler.patches().size()};
}

namespace {

// Removes the angles of the texels that are black in a mask, and counts them.
std::size_t leaveOut(const Image& mask, std::vector<float>& degrees)
{
    std::vector<glm::vec4> row(std::size_t(mask.width));
    std::size_t count = 0;
    for (int y = 0; y < mask.height; ++y) {
        loadRow(mask, y, row);
        for (std::size_t x = 0; x < row.size(); ++x)
            if (std::max({row[x].x, row[x].y, row[x].z}) <= 0) {
                degrees[std::size_t(y) * row.size() + x] = -1;
                ++count;
            }
    }
    return count;
}

} // namespace

Result<ComparedFiles> compareFiles(const std::filesystem::path& fileA, const StatedConvention& statedA,
                                   const std::filesystem::path& fileB, const StatedConvention& statedB,
                                   const std::filesystem::path& heat, const FileOptions& files,
                                   const std::filesystem::path& mask)
{
    COTAN_TRY(a, openMap(fileA, statedA, "options.from", files.limits));
    COTAN_TRY(b, openMap(fileB, statedB, "options.to", files.limits));
    std::vector<RowReader*> readers = {a->rows.get(), b->rows.get()};
    std::unique_ptr<RowReader> maskRows;
    if (!mask.empty()) {
        COTAN_TRY(opened, openRows(mask, files.limits));
        maskRows = *std::move(opened);
        readers.push_back(maskRows.get());
    }
    const int width = readers[0]->width, height = readers[0]->height;
    for (const auto& [reader, file] : {std::pair(readers[1], &fileB), {readers.back(), maskRows ? &mask : &fileB}})
        if (width != reader->width || height != reader->height)
            return inputError(fmt::format("{}: expected {} x {} as {} has, found {} x {}", file->string(), width,
                                          height, fileA.string(), reader->width, reader->height));
    std::unique_ptr<RowWriter> heatWriter;
    if (!heat.empty()) {
        COTAN_TRY(writer, createRows(heat, {width, height, PixelType::unorm8, false, false}, files.threads));
        heatWriter = *std::move(writer);
    }
    AngleCounter angles;
    std::atomic<std::size_t> masked = 0;
    const auto work = [&](std::span<Image> strips, int firstRow) -> std::function<Status()> {
        a->put(strips[0], firstRow);
        b->put(strips[1], firstRow);
        auto degrees = anglesBetween(strips[0], a->convention, strips[1], b->convention);
        if (maskRows)
            masked += leaveOut(strips[2], degrees);
        Image rows = heatWriter ? heatMap(degrees, width, strips[0].height) : Image{};
        return [&, degrees = std::move(degrees), rows = std::move(rows)]() -> Status {
            for (float d : degrees)
                angles.add(d);
            return heatWriter ? heatWriter->write(rows) : Status(Done{});
        };
    };
    COTAN_CHECK(streamStrips(readers, {}, files.progress, work));
    if (heatWriter)
        COTAN_CHECK(heatWriter->finish());
    const AngleStatistics s = angles.statistics();
    ComparedFiles done{s, std::size_t(width) * std::size_t(height) - s.count - masked, masked, a->convention,
                       b->convention};
    addNote(a->note(), done.notes);
    addNote(b->note(), done.notes);
    return done;
}

} // namespace cotan::app
