#include "tbb_by_threads.hpp" // see there
