// A GDAL driver, loaded from GDAL_DRIVER_PATH, that simulates the faults of libraries. Its files
// contain "FAULTY" and, after a blank, the name of the fault.
#include <gdal_priv.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

namespace {

std::string faultOf(const GDALOpenInfo& info)
{
    const std::string text(reinterpret_cast<const char*>(info.pabyHeader),
                           static_cast<std::size_t>(info.nHeaderBytes));
    return text.substr(std::strlen("FAULTY "), text.find('\n') - std::strlen("FAULTY "));
}

void hang()
{
    volatile bool is_on = true;
    while (is_on) {
    }
}

// Each call uses a page of the stack.
int overflow(volatile char* above)
{
    volatile char page[4096];
    page[0] = *above;
    return page[0] == 0 ? overflow(page) + page[0] : 0; // always true
}

void takeMemory()
{
    for (;;) {
        char* const bytes = new char[std::size_t{16} << 20];
        std::memset(bytes, 1, std::size_t{16} << 20);
    }
}

class Band final : public GDALRasterBand {
public:
    Band(GDALDataset* map, std::string fault)
        : fault_(std::move(fault))
    {
        poDS = map;
        nBand = 1;
        eDataType = GDT_Int16;
        nBlockXSize = 20;
        nBlockYSize = 1;
    }

private:
    CPLErr IReadBlock(int, int row, void* to) override
    {
        if (fault_ == "crash while reading" && row == 15) {
            std::abort();
        }
        if (fault_ == "crash while reading slowly") {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            if (row == 15) {
                std::abort();
            }
        }
        if (fault_ == "print") {
            std::fprintf(stderr, "library: row %d\n", row);
        }
        for (int i = 0; i < 20; ++i) {
            static_cast<GInt16*>(to)[i] = static_cast<GInt16>(row * 20 + i);
        }
        return CE_None;
    }

    std::string fault_;
};

class Map final : public GDALDataset {
public:
    explicit Map(std::string fault)
        : fault_(fault)
    {
        nRasterXSize = 20;
        nRasterYSize = 20;
        SetBand(1, new Band(this, std::move(fault)));
    }
    ~Map() override
    {
        if (fault_ == "crash while closing") {
            std::raise(SIGSEGV);
        }
    }

private:
    std::string fault_;
};

int identify(GDALOpenInfo* info)
{
    return info->nHeaderBytes > 7 &&
                   std::memcmp(info->pabyHeader, "FAULTY ", std::strlen("FAULTY ")) == 0
               ? TRUE
               : FALSE;
}

GDALDataset* open(GDALOpenInfo* info)
{
    if (identify(info) == FALSE) {
        return nullptr;
    }
    const std::string fault = faultOf(*info);
    if (fault == "crash") {
        std::abort();
    } else if (fault == "overflow") {
        volatile char top = 0;
        overflow(&top);
    } else if (fault == "hang") {
        hang();
    } else if (fault == "memory") {
        takeMemory();
    } else if (fault == "killed") {
        std::raise(SIGKILL); // as the kernel does when the machine has no memory left
    } else if (fault == "print") {
        std::fprintf(stderr, "library: first\nlibrary: second\n");
        std::printf("library: on stdout\n");
    } else if (fault == "crash at exit") {
        static const int once = std::atexit([] { std::abort(); }); // as libraries do
        if (once != 0) {
            return nullptr;
        }
    } else if (fault == "write") {
        if (std::FILE* file = std::fopen((std::string(info->pszFilename) + ".made").c_str(), "w")) {
            std::fclose(file);
        }
        return nullptr;
    } else if (fault == "refuse") {
        std::fprintf(stderr, "library: I refuse\n");
        CPLError(CE_Failure, CPLE_AppDefined, "The header is wrong.\nIn two lines.");
        return nullptr;
    }
    return new Map(fault);
}

} // namespace

extern "C" CPL_DLL void GDALRegister_FAULTY(); // the name that GDAL searches for

void GDALRegister_FAULTY()
{
    auto* driver = new GDALDriver;
    driver->SetDescription("FAULTY");
    driver->SetMetadataItem(GDAL_DCAP_RASTER, "YES");
    driver->SetMetadataItem(GDAL_DCAP_OPEN, "YES");
    driver->pfnIdentify = identify;
    driver->pfnOpen = open;
    GetGDALDriverManager()->RegisterDriver(driver);
}
