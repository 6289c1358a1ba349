MODULE a_main
  VAR num shared:=1;
  LOCAL VAR num own:=2;
  PROC main()
    helper shared;
    shared:=limit;
    own:=private;                       ! error: N201
    secret;                             ! error: N209
  ENDPROC
ENDMODULE
