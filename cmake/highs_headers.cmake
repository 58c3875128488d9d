# Included when scripts/build-highs configures HiGHS: precompiles the standard headers that most of its sources include.
set(headers algorithm atomic cassert chrono cmath condition_variable fstream functional iostream map memory mutex random
            set sstream string thread unordered_map vector)
list(TRANSFORM headers REPLACE "(.+)" "$<$<COMPILE_LANGUAGE:CXX>:<\\1$<ANGLE-R>>")
cmake_language(DEFER CALL target_precompile_headers highs PRIVATE ${headers})
