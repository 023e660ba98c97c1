#include "tables.hpp"

#include <iterator>

#include "core/loops.hpp"

namespace cotan {

const std::vector<AccuracyTable>& accuracyTables()
{
    static const std::vector<AccuracyTable> tables = {
        {"flat", "flat patches: seven layouts of uv, stretched, sheared, mirrored, scaled", measureFlat},
        {"foreshortening", "a square patch tilted by 0 to 85 degrees, no perspective", measureForeshortening},
        {"perspective", "a ground plane up to the horizon", measurePerspective},
        {"views", "whether the frame depends on the source of its differences", measureViews},
        {"signs", "handedness, rows up and down, facing, mirroring; green and v", measureSigns},
        {"curved", "a relief on sphere, Mercator sphere, torus and spout; 8 to 256 segments", measureCurved},
        {"facets", "steps across the edges of triangles, errors inside", measureFacets},
        {"precision", "float: distance from the origin, pixel size, size of uv", measurePrecision},
        {"half", "half-precision arithmetic", measureHalf},
        {"degenerate", "nineteen kinds of difficult pixel", measureDegenerate},
        {"procedural", "uv computed in the shader", measureProcedural},
    };
    return tables;
}

Result<std::vector<Measurement>> measureTables(const std::vector<const AccuracyTable*>& tables,
                                               const AccuracySelection& selection, int threads,
                                               const Progress& progress)
{
    std::vector<std::vector<Measurement>> results(tables.size());
    CountedSteps steps(progress, tables.size());
    runTasks(tables.size(), threadsFor(tables.size(), 1, threads), [&](std::size_t i) {
        if (steps.stopped())
            return;
        results[i] = tables[i]->measure(selection);
        steps.step();
    });
    if (steps.stopped())
        return stoppedError();
    std::vector<Measurement> rows;
    for (auto& part : results)
        rows.insert(rows.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
    return rows;
}

} // namespace cotan
