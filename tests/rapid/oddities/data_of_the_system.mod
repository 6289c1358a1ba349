! Field practice, Predefined data: reg1 to reg5 and clock1 are used without a declaration.
MODULE data_of_the_system
  CONST speeddata v2:=[2,500,5000,1000];
  VAR speeddata v6:=[6,500,5000,1000];
  CONST speeddata vMine:=v100;

  PROC main()
    reg1:=3;
    reg5:=reg1+v2.v_tcp+v6.v_tcp+vMine.v_tcp;
    TPWrite ValToStr(reg5);               ! -> 111
    ClkReset clock1;
    ClkStart clock1;
    WaitTime 1;
    ClkStop clock1;
    TPWrite ValToStr(ClkRead(clock1));    ! -> 1
  ENDPROC
ENDMODULE
