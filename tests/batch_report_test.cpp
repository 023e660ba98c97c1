// The page and the report of a batch: every field of a job, with distinct values; the page in a browser.
#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "batch/report.hpp"
#include "batch_fixture.hpp"

namespace cotan {
namespace {

using namespace app;
using namespace test;
using nlohmann::json;

struct Results {
    JobList list{"/jobs", {}};
    std::vector<JobResult> all;

    // mean: degrees; negative: none.
    JobRecord& add(const std::string& name, JobState state, double mean = -1)
    {
        addJob(list, {"lint", "a b.glb", name.substr(name.find(' ') + 1)}).name = name;
        list.jobs.back().line += 9;
        JobRecord& record = all.emplace_back(JobResult{all.size(), {}, false}).record;
        record.state = state;
        if (mean >= 0)
            record.degrees = Degrees{mean, "of"};
        return record;
    }
};

// In the order of their names; the second has all fields, the others have none.
Results oneOfEachState()
{
    Results results;
    for (int i = 0; i < 8; ++i)
        results.add("job " + std::to_string(i), JobState(i));
    JobRecord& r = results.all[1].record;
    r.code = 5;
    r.signal = 15;
    r.runs = 3;
    r.reason = "over 2 degrees";
    r.output = std::string(1500, 'x');
    r.seconds = 1.23456;
    r.processorSeconds = 2.5;
    r.megabytes = 20.75;
    r.degrees = Degrees{4.5, "between the maps"};
    r.thumbnail = {7, 9, "AAAA"};
    r.inputs = {{"a.glb", "00"}, {"b.png", "01"}};
    r.outputs = {{"out/c d.png", "02"}, {"/report/sub/e~1.txt", "03"}};
    results.all[1].kept = true;
    return results;
}

json dataOf(const std::string& page)
{
    const std::string begin = "id=\"data\">";
    const std::size_t at = page.find(begin) + begin.size();
    return json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(BatchReport, aRowOfThePageHasEveryFieldOfItsJob)
{
    const Results results = oneOfEachState();
    const std::string page = batchPage(results.list, results.all, "a & b", "the end", "/report", 8);
    const json data = dataOf(page);
    EXPECT_EQ(data["states"],
              json({"done", "over limit", "not run", "skipped", "failed", "too slow", "out of memory", "crashed"}));
    EXPECT_EQ(data["bad"], json({4, 5, 6, 7}));
    EXPECT_EQ(data["warn"], json({1, 2, 3}));
    ASSERT_EQ(data["rows"].size(), 8u);
    const std::string command = "lint 'a b.glb' ";
    // Worst first: crashed, memory, late, over the limit, refused, skipped, not run, done.
    const int order[] = {7, 6, 5, 1, 4, 3, 2, 0};
    for (std::size_t i = 0; i < 8; ++i) {
        const std::string number = std::to_string(order[i]);
        if (order[i] == 1) {
            EXPECT_EQ(data["rows"][i],
                      json({"job 1",
                            1,
                            4.5,
                            "between the maps",
                            1.235,
                            21.0,
                            command + "1",
                            "over 2 degrees",
                            std::string(1500, 'x'),
                            json::array({json::array({"out/c d.png", "../jobs/out/c%20d.png"}),
                                         json::array({"/report/sub/e~1.txt", "sub/e~1.txt"})}),
                            {"a.glb", "b.png"},
                            {7, 9, "AAAA"},
                            1}));
        } else {
            EXPECT_EQ(data["rows"][i],
                      json({"job " + number, order[i], nullptr, "", 0.0, 0.0, command + number, "", "", json::array(),
                            json::array(), nullptr, 0}));
        }
    }
    EXPECT_NE(page.find("<title>a &amp; b</title>"), std::string::npos);
    EXPECT_NE(page.find("<h1>a &amp; b</h1>"), std::string::npos);
    EXPECT_NE(page.find("<footer>the end</footer>"), std::string::npos) << "all are shown";
    // One button for each state present, worst first, with its number and count.
    std::vector<JobResult> some = results.all;
    some.push_back(some[4]);
    some.erase(some.begin() + 6); // no job is out of memory
    const std::string other = batchPage(results.list, some, "t", "f", "/report", 8);
    std::size_t at = 0;
    for (const char* button : {"\"7\">1 crashed<", "\"5\">1 too slow<", "\"4\">2 failed<", "\"3\">1 skipped<",
                               "\"2\">1 not run<", "\"1\">1 over limit<", "\"0\">1 done<"})
        ASSERT_NE(at = other.find(std::string("data-state=") + button, at), std::string::npos) << button;
    EXPECT_EQ(other.find("out of memory<"), std::string::npos);
}

// Shows the first 1500 bytes of jobs that are done, and all kept output of others.
TEST(BatchReport, outputOfFinishedJobsIsTruncatedOnThePage)
{
    for (const JobState state :
         {JobState::done, JobState::limit, JobState::skipped, JobState::failed, JobState::crashed})
        for (const std::size_t size : {1500, 1501, 4000}) {
            Results results;
            const std::string output = std::string(size - 1, 'y') + "z";
            results.add("job", state).output = output;
            const std::string printed = dataOf(batchPage(results.list, results.all, "", "", "/", 1))["rows"][0][8];
            const bool cut = size > 1500 && (state == JobState::done || state == JobState::limit);
            EXPECT_EQ(printed, cut ? std::string(1500, 'y') + "..." : output) << size << int(state);
        }
}

TEST(BatchReport, asJsonHasTheCountOfEachStateAndEveryFieldOfEachJob)
{
    const Results results = oneOfEachState();
    const json report = json::parse(toText(batchJson(results.list, results.all)));
    EXPECT_EQ(report["command"], "batch");
    for (const char* state :
         {"done", "over limit", "not run", "skipped", "failed", "too slow", "out of memory", "crashed"})
        EXPECT_EQ(report["counts"][state], 1) << state;
    ASSERT_EQ(report["jobs"].size(), 8u);
    EXPECT_EQ(report["jobs"][3],
              json({{"name", "job 1"},
                    {"line", 11},
                    {"command", {"lint", "a b.glb", "1"}},
                    {"state", "over limit"},
                    {"code", 5},
                    {"signal", 15},
                    {"runs", 3},
                    {"reason", "over 2 degrees"},
                    {"kept", true},
                    {"degrees", 4.5},
                    {"degrees_of", "between the maps"},
                    {"seconds", 1.23456},
                    {"processor_seconds", 2.5},
                    {"megabytes", 20.75},
                    {"inputs", {"a.glb", "b.png"}},
                    {"outputs", {"out/c d.png", "/report/sub/e~1.txt"}}}));
    for (const char* none : {"code", "signal", "degrees", "degrees_of"})
        EXPECT_TRUE(report["jobs"][0][none].is_null()) << none;
    EXPECT_EQ(report["jobs"][0]["name"], "job 7");
    EXPECT_EQ(report["jobs"][7]["kept"], false);
}

TEST(BatchReport, theSummaryCountsStatesInOrderAndReusedResults)
{
    Results results = oneOfEachState();
    EXPECT_EQ(summaryOf(results.all),
              "8 jobs: 1 done, 1 over limit, 1 not run, 1 skipped, 1 failed, 1 too slow, 1 out of memory, 1 crashed; "
              "1 from an earlier run");
    results.all.resize(1);
    EXPECT_EQ(summaryOf(results.all), "1 job: 1 done");
    results.all.clear();
    EXPECT_EQ(summaryOf(results.all), "0 jobs");
}

// Jobs over their limit come before failed ones, which say nothing about the model; equal ones keep their order.
TEST(BatchReport, sortsTheWorstFirst)
{
    Results results;
    for (const JobState state :
         {JobState::done, JobState::failed, JobState::limit, JobState::skipped, JobState::notRun, JobState::late,
          JobState::crashed, JobState::memory, JobState::limit, JobState::done, JobState::done, JobState::done})
        results.add("job", state, state == JobState::limit ? double(results.all.size()) : -1);
    results.all[9].record.degrees = Degrees{0.5, ""};
    results.all[11].record.degrees = Degrees{7, ""};
    EXPECT_EQ(worstFirst(results.all), (std::vector<std::size_t>{6, 7, 5, 8, 2, 1, 3, 4, 11, 9, 0, 10}));
}

TEST(BatchReport, escapesTextOfJobs)
{
    Results results;
    for (const char* name : {"good", "<b>crash</b>", "unknown"}) {
        JobRecord& record = results.add(name, *name == '<' ? JobState::crashed : JobState::done, 1);
        results.list.jobs.back().words = {"lint", "</script><script>alert(1)</script>"};
        record.reason = "<img src=x onerror=alert(2)>";
        record.output = "<!--<script>";
        record.degrees->of = "<i>";
        record.outputs = {{"/out/\"><script>%20 ü", "00"}};
    }
    const std::string page = batchPage(results.list, results.all, "</title><script>", "<footer>", "/report", 100);
    const auto count = [&](const std::string& what) {
        std::size_t n = 0;
        for (std::size_t at = 0; (at = page.find(what, at)) != std::string::npos; ++at)
            ++n;
        return n;
    };
    // The column headings, from left to right.
    std::size_t at = page.find("class=\"row head\"");
    for (const char* const head : {">Job<", ">State<", ">Degrees<", ">Seconds<", ">MiB<", "id=\"list\""}) {
        ASSERT_NE(at = page.find(head, at), std::string::npos) << head;
    }
    EXPECT_EQ(count("<script"), 2u);
    EXPECT_EQ(count("</script>"), 2u);
    EXPECT_EQ(count("<img") + count("<b>") + count("<!--"), 0u);
    EXPECT_NE(page.find("\"../out/%22%3E%3Cscript%3E%2520%20%C3%BC\""), std::string::npos);
    const std::string two = batchPage(results.list, results.all, "t", "f", "/report", 2);
    EXPECT_NE(two.find("the worst 2 of 3; f"), std::string::npos);
    EXPECT_NE(two.find("crash"), std::string::npos);
    EXPECT_EQ(two.find("\"unknown\""), std::string::npos);
}

// The worst map of a model counts, read with its best frame, and measurements in renders before other ones.
TEST(BatchDegrees, areReadFromTheFieldOfEachCommand)
{
    struct Row {
        const char *report, *of;
        double mean;
    };
    const Row rows[] = {
        {R"({"command": "bake", "verify": {"all": {"mean_degrees": 3}, "views": 1}})", "against the detailed mesh", 3},
        {R"({"command": "bake", "objects": [{"verify": {"all": {"mean_degrees": 1}}},
            {"verify": {"all": {"mean_degrees": 3}}}, {"verify": {"all": {"mean_degrees": null}}}]})",
         "against the detailed mesh", 3},
        {R"({"command": "convert", "maps": [{"degrees_after_rounding": {"mean": 2}, "degrees_unconverted": {"mean": 1}},
            {"degrees_after_rounding": {"mean": 0.5}, "degrees_unconverted": {"mean": 9}}]})",
         "read with the new frame", 1},
        {R"({"command": "convert", "verify": {"degrees": {"mean_degrees": 4}}})", "drawn, against the original", 4},
        {R"({"command": "convert", "maps": [{"degrees_unconverted": {"mean": 5}}],
            "verify": {"degrees": {"mean_degrees": 0.5}}})",
         "drawn, against the original", 0.5},
        {R"({"command": "compare", "normals": {"mean_degrees": 5}})", "between the frames", 5},
        {R"({"command": "map diff", "angles": {"mean_degrees": 6}})", "between the maps", 6},
        {R"({"command": "tangents", "whole": {"directions": {"mean_degrees": 7}}})", "stored tangents", 7},
        {R"({"command": "lint", "fits": [{"cotangent": {"mean": 8}}]})", "read without tangents", 8},
        {R"({"command": "lint", "fits": [
            {"orthonormal": {"mean": 4}, "cotangent": {"mean": 3}, "smooth": {"mean": 2}},
            {"orthonormal": {"mean": 1}, "cotangent": {"mean": 9}, "smooth": {"mean": 9}}]})",
         "read without tangents", 2}};
    for (const Row& row : rows) {
        const auto degrees = degreesIn(row.report);
        ASSERT_TRUE(degrees) << row.report;
        EXPECT_EQ(degrees->mean, row.mean) << row.report;
        EXPECT_EQ(degrees->of, row.of) << row.report;
    }
    for (const char* none : {"", "{", "[]", "{\"command\": \"lint\"}", "{\"command\": \"lint\", \"fits\": []}",
                             "{\"command\": 3}", "{\"command\": \"lint\", \"fits\": {\"orthonormal\": 1}}",
                             "{\"command\": \"compare\", \"normals\": {\"mean_degrees\": null}}"})
        EXPECT_FALSE(degreesIn(none)) << none;
}

// ---- the page in a browser ---------------------------------------------------------------------

// The JSON that `script`, run at the end of the page, puts into the page's title.
json titleAfter(const Results& input, const std::string& script)
{
    TemporaryFolder folder;
    std::string page = batchPage(input.list, input.all, "jobs", "footer", "/report", 100000);
    page.insert(page.find("</body>"),
                "<script>document.title = 'RESULT' + JSON.stringify((() => {" + script + "})());</script>");
    write(folder / "page.html", page);
    const std::string f = folder.path().string();
    const std::string line =
        fmt::format("timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir='{0}/profile' "
                    "--window-size=1000,800 --dump-dom 'file://{0}/page.html' > '{0}/dom' 2> '{0}/log'",
                    f);
    const int code = std::system(line.c_str());
    const std::string dom = readWhole(folder / "dom");
    const std::size_t begin = dom.find("<title>RESULT"), end = dom.find("</title>", begin);
    if (begin == std::string::npos)
        return {{"error", fmt::format("chromium printed no result, exit {}: {}", code, dom.substr(0, 80))}};
    std::string text = dom.substr(begin + 13, end - begin - 13);
    for (const auto& [from, to] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}})
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; ++at)
            text.replace(at, std::string_view(from).size(), to);
    return json::parse(text);
}

bool noBrowser() { return std::system("command -v chromium > /dev/null 2>&1") != 0; }

TEST(BatchPage, onlyVisibleRowsExistAndTheyFilterAndSort)
{
    if (noBrowser())
        GTEST_SKIP() << "no chromium";
    Results input;
    for (int i = 0; i < 10000; ++i)
        input.add(fmt::format("rock {}", i), i % 100 == 7 ? JobState::crashed : JobState::done, i % 2 ? i / 100.0 : -1);
    json got = titleAfter(input, R"(
        const names = () => [...document.querySelectorAll('#space .name')].map(e => e.textContent);
        const result = { rows: names().length, first: names()[0], height: space.offsetHeight };
        find.value = 'ROCK 99'; find.dispatchEvent(new Event('input'));
        result.found = shown.length;
        find.value = ''; find.dispatchEvent(new Event('input'));
        const press = column => document.querySelector(`[data-column="${column}"]`).click();
        press(2); result.most = names()[0];
        press(2); result.least = names()[0];
        press(0); result.byName = names().slice(0, 3);
        press(0); press(0); result.again = names()[0];
        document.querySelector('[data-state="7"]').click(); result.crashed = shown.length;
        list.scrollTop = 50 * 64; draw(false); result.scrolled = names().includes('rock 5007');
        return result;)");
    EXPECT_LT(got.value("rows", 10000), 60) << got;
    EXPECT_GT(got.value("rows", 0), 5) << got;
    EXPECT_EQ(got["first"], "rock 9907") << "crashed, with the most degrees";
    EXPECT_EQ(got["height"], 640000);
    EXPECT_EQ(got["found"], 280) << "numbers of four digits with two nines beside each other: 3 * 100 - 21 + 1";
    EXPECT_EQ(got["most"], "rock 9999");
    EXPECT_EQ(got["least"], "rock 1");
    EXPECT_EQ(got["byName"], json({"rock 0", "rock 1", "rock 2"})) << "numbers as numbers";
    EXPECT_EQ(got["again"], got["first"]);
    EXPECT_EQ(got["crashed"], 100);
    EXPECT_EQ(got["scrolled"], true);
}

TEST(BatchPage, jobNamesAreShownAsTextAndNeverExecuted)
{
    if (noBrowser())
        GTEST_SKIP() << "no chromium";
    const std::string evil =
        "</script><script>window.ran = 1</script><img src=x onerror='window.ran = 2'><!-- <script> ü\"&";
    Results input;
    JobRecord& record = input.add(evil, JobState::failed, 1);
    record.degrees->of = record.output = evil;
    record.outputs = {{"out/" + evil, "00"}};
    record.thumbnail = {1, 1, "\" onerror=\"window.ran = 3"};
    json got = titleAfter(input, R"(
        document.querySelector('#space .row').click();
        return { name: document.querySelector('#space .name').textContent, ran: window.ran || 0,
                 heading: document.querySelector('dialog h2').textContent, open: document.querySelector('dialog').open,
                 link: document.querySelector('dialog a').href, bad: document.querySelectorAll('.row.bad').length };)");
    EXPECT_EQ(got["name"], evil);
    EXPECT_EQ(got["heading"], evil);
    EXPECT_EQ(got["ran"], 0);
    EXPECT_EQ(got["open"], true);
    EXPECT_EQ(got["bad"], 1);
    EXPECT_NE(got["link"].get<std::string>().find("/jobs/out/%3C/script%3E"), std::string::npos) << got;
}

} // namespace
} // namespace cotan
