// Rows of a table that collect measurements.
#pragma once

#include <utility>
#include <vector>

#include "truth/measurement.hpp"
#include "truth/patch.hpp"

namespace cotan {

// One row for each frame in double and one in float.
struct FrameRows {
    struct Row {
        Frame frame;
        bool single; // float
        Measurement names;
        AngleCollector angles;
    };
    std::vector<Row> rows;

    // Adds both rows of a frame if it is selected. `names` lacks frame and arithmetic.
    void add(const AccuracySelection& selection, Frame frame, const Measurement& names)
    {
        for (bool single : {false, true})
            addOne(selection, frame, single, names);
    }

    // Adds the row of one arithmetic.
    void addOne(const AccuracySelection& selection, Frame frame, bool single, Measurement names)
    {
        if (!selection.wants(frame))
            return;
        names.frame = name(frame);
        names.arithmetic = single ? "float" : "double";
        rows.push_back({frame, single, std::move(names), {}});
    }

    void finish(std::vector<Measurement>& into)
    {
        for (Row& row : rows)
            into.push_back(row.angles.finish(std::move(row.names)));
    }
};

inline glm::dvec3 shadeAs(bool single, Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 m)
{
    return single ? shadeFloat(frame, n, d, m) : shade(frame, n, d, m);
}

// Frames that are built from differences, including `exact`, which accepts any two.
inline std::vector<Frame> differenceFrames()
{
    std::vector<Frame> list;
    for (const FrameInfo& f : frames())
        if (!readsVertices(f.frame))
            list.push_back(f.frame);
    return list;
}

} // namespace cotan
