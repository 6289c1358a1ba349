MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR rawbytes rb;
  VAR pose pose1;
  PROC main()
    UnpackRawBytes rb,1,pose1\Hex1;
  ENDPROC
ENDMODULE
