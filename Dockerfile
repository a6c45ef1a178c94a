# The program in a container: docker build -t frangia . && docker run --rm -v "$PWD:/data" frangia reconstruct scan -o part.ply
# The steps are those of `./run package`, which tries the last stage in a new system without Docker.
FROM debian:12 AS build
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends git ca-certificates
COPY . /frangia
WORKDIR /frangia
RUN ./run package make

FROM debian:12
COPY --from=build /frangia/out/packages /packages
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends /packages/frangia_*.deb /packages/python3-frangia_*.deb >/dev/null
WORKDIR /data
ENTRYPOINT ["frangia"]
CMD ["--help"]
