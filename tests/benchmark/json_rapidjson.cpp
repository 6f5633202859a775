#include "tests/benchmark/json_rapidjson.h"

const seaglare::benchmark::JsonParser seaglare::benchmark::rapidjson_parser = {"RapidJSON", parse, contents};
