# SPDX-License-Identifier: MIT
# Grove in a container: its Debian packages are made in one stage and installed in the next.
#
#   docker build -t grove .
#   docker run --rm --user "$(id -u)" -v "$PWD:/data" grove solve my.cts.json
FROM debian:12 AS build
WORKDIR /grove
COPY . .
RUN tools/package

FROM debian:12-slim
COPY --from=build /grove/build/package/*.deb /packages/
RUN apt-get update \
 && apt-get install -y --no-install-recommends /packages/grove_*.deb /packages/grove-mpi_*.deb \
      /packages/grove-pictures_*.deb /packages/python3-grove_*.deb \
      openmpi-bin python3-matplotlib python3-numpy \
 && rm -rf /packages /var/lib/apt/lists/* \
 && /usr/share/grove/smoke-test
WORKDIR /data
ENTRYPOINT ["grove"]
