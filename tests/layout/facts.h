#ifndef TESTS_LAYOUT_FACTS_H
#define TESTS_LAYOUT_FACTS_H

#include <map>
#include <string>

/// Layout of ODE's classes by their declarations: offsets, sizes, places of virtual functions, numbers.
using LayoutFacts = std::map<std::string, long>;

LayoutFacts facts_of_odes_headers();
LayoutFacts facts_of_our_header();

#endif
