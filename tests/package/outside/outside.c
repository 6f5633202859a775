#include <seaglare.h>
#include <stdio.h>

int main(void) {
    seaglare_api api = {sizeof api};
    seaglare_create_info info = {sizeof info, SEAGLARE_CREATE_NO_OPENCL, .config_path = CONFIG_DIR};
    seaglare_context* context = NULL;
    char text[512] = "";
    if (seaglare_get_api(SEAGLARE_ABI_MAJOR, &api) < 0) return 1;
    seaglare_result result = api.create(&info, &context);
    if (result >= 0) result = api.load_lights(context, CONFIG_DIR "/lights/great_belt.json");
    api.copy_last_error(result < 0 ? context : NULL, text, sizeof text);
    printf("%s\n%s\n", api.result_string(result), text);
    return result < 0 || api.destroy(context) < 0;
}
