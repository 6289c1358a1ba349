MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR rawbytes rb;
  PROC main()
    PackRawBytes p2,rb,1\Hex1;
    PackRawBytes p1,rb,1\Float4;
    PackRawBytes p1.trans,rb,1\IntX:=DINT;
  ENDPROC
ENDMODULE
