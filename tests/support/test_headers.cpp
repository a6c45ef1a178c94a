// What every test includes, compiled once: see CMakeLists.txt beside.
#include <gtest/gtest.h>
