//! Genotype files; what is understood is written and read again.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::genotype::Genotypes;

fuzz_target!(|text: &str| {
    if let Ok(genotypes) = Genotypes::from_json("g.json", text) {
        let json = serde_json::to_string(&genotypes).expect("cells are plain values");
        assert_eq!(
            Genotypes::from_json("g.json", &json).expect("as written"),
            genotypes
        );
    }
});
