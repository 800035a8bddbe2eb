# The two commands on a clean Debian 12:
#   docker build -t recoil .              make demo, at the end of which the program is there
#   docker run --rm recoil make test      the tests
FROM debian:12-slim
RUN apt-get update \
 && apt-get install -y --no-install-recommends ca-certificates git make \
 && rm -rf /var/lib/apt/lists/*
WORKDIR /recoil
COPY . .
RUN make demo
ENV PATH="/recoil/build/release:${PATH}"
CMD ["recoil", "--help"]
