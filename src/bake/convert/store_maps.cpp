#include <utility>

#include <fmt/format.h>

#include "bake/convert/map_jobs.hpp"
#include "core/try.hpp"
#include "cotan/convert.hpp"
#include "cotan/image.hpp"

namespace cotan {

Result<StoredMaps> storeNormalMaps(GltfDocument& document, const EncodeTexture& encode, const std::string& extension,
                                   const LoadLimits& limits, const Progress& progress)
{
    GltfDocument changed = document;
    StoredMaps done;
    std::vector<std::string> told; // by the conversion
    COTAN_TRY(jobs, mapJobs(changed, told, limits));
    CountedSteps steps(progress, jobs->size() + 1);
    for (const MapJob& job : *jobs) {
        if (!steps.step())
            return stoppedError();
        COTAN_TRY(bytes, gltfImageBytes(changed, job.image, limits));
        if (imageFormatName(*bytes) == "KTX2") {
            done.notes.push_back(fmt::format("{}: is KTX2, and stays as it is", job.name));
            continue;
        }
        COTAN_TRY(map, decodeImage(*bytes, job.name, limits));
        if (extension == "KHR_texture_basisu" && (map->width % 4 != 0 || map->height % 4 != 0)) {
            done.notes.push_back(
                fmt::format("{}: {} x {} texels; stays as it is, since KHR_texture_basisu needs multiples "
                            "of 4",
                            job.name, map->width, map->height));
            continue;
        }
        COTAN_TRY(texture, encode(*map, job.name));
        done.maps.push_back({job.image, job.name, bytes->size(), texture->size()});
        replaceMap(changed, job, *std::move(texture), "image/ktx2", done.notes, extension);
    }
    document = std::move(changed);
    return done;
}

} // namespace cotan
