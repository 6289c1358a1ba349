! Field practice, Numbers: masks in hexadecimal and binary.
MODULE hexadecimal
  VAR byte mask:=0xF0;
  CONST num MASKS{3}:=[0x01,0b10,0x7fff];

  PROC main()
    TPWrite ValToStr(BitAnd(mask,0b11000011));  ! -> 192
    TPWrite ValToStr(MASKS);                    ! -> [1,2,32767]
  ENDPROC
ENDMODULE
