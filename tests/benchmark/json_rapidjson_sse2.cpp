#ifdef __SSE2__
#define RAPIDJSON_SSE2
#endif
#define RAPIDJSON_NAMESPACE rapidjson_sse2
#define RAPIDJSON_NAMESPACE_BEGIN namespace rapidjson_sse2 {
#define RAPIDJSON_NAMESPACE_END }
#include "tests/benchmark/json_rapidjson.h"

const seaglare::benchmark::JsonParser seaglare::benchmark::rapidjson_sse2_parser = {"RapidJSON_SSE2", parse,
                                                                                    contents};
