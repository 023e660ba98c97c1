# The tool without its window, on Debian 13, for pipelines: docs/how-to/container.md.
# BASE: an image of Debian 13 (trixie) with apt.
ARG BASE=docker.io/library/debian:trixie-slim

FROM ${BASE} AS build
COPY . /cotan
RUN apt-get update && /cotan/scripts/deb-packages /packages

FROM ${BASE}
COPY --from=build /packages/cotan_*.deb /packages/
RUN apt-get update && apt-get install -y --no-install-recommends /packages/cotan_*.deb \
  && rm -rf /packages /var/lib/apt/lists/* /var/cache/apt/* && useradd --create-home cotan
USER cotan
WORKDIR /work
ENTRYPOINT ["cotan"]
CMD ["--help"]
