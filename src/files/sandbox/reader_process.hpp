// The parent's side of a sandboxed reader: start, data exchange, time limit and end.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "files/sandbox/child.hpp"
#include "files/sandbox/request.hpp"

namespace cotan {

class ReaderProcess {
public:
    // Starts limits.sandbox.program, sends it the request and what `more` writes, and awaits the first result.
    // Errors: ErrorKind::unavailable if it cannot be started; those of await().
    static Result<std::unique_ptr<ReaderProcess>> start(ReaderRequest request,
                                                        const std::function<void(WireOut&)>& more = {});

    ~ReaderProcess(); // kills it
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    WireIn& answer() { return answer_; }
    WireOut& question() { return question_; } // write errors are reported by await()

    // Sends what is still buffered of the question, and waits for a result. On success the value follows in answer().
    // Errors: the reader's own; failure().
    Status await();

    // Restarts the time limit.
    void restartClock();

    // Returns why answer() is not good. Ends the process.
    Error failure();

private:
    explicit ReaderProcess(const ReaderRequest& request);

    void setLimits();

    LoadLimits limits_;
    std::string name_, reader_; // the file, and "the reader of FBX files"
    std::size_t fileBytes_, decodedBytes_ = 0;
    Child child_;
    Child::Clock::time_point began_ = Child::Clock::now();
    WireIn answer_;
    WireOut question_;
};

} // namespace cotan
